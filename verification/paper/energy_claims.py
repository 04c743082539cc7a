"""The claims on fracture energies: what they do to the curve past the peak, and to the crack."""

from collections.abc import Mapping

from masonry.results import Result

Series = Mapping[float, Result]
WINDOW, SMOOTH = 5e-6, 0.10
"""m, and the largest share of the peak that a smooth curve falls by within it: 4.8 times the fall of the paper's law
would be a drop."""


def first_mode_claims(found):
    return []


def second_mode_claims(found):
    return []
