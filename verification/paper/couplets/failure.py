"""How evenly a couplet with a bed of mortar is loaded as it fails."""

from verification.paper.couplets.laws import CONFINEMENTS
from verification.paper.couplets.measures import Interfaces, interfaces
from verification.paper.couplets.mortar import SIZES, known, name
from verification.paper.experiment import Claim, Done, claim

UNEVEN = 0.2
"""Share of the confinement by which the stress on a joint scatters that is not uniform."""


def claims(done: Done) -> list[Claim]:
    """Section 4 on uniform stress."""
    even = {name(s, c): (interfaces(done[name(s, c)]), CONFINEMENTS[c]) for s in SIZES for c in known(done, s)}
    return [uneven(even)]


def uneven(even: dict[str, tuple[Interfaces, float]]) -> Claim:
    """The normal stress along the interfaces at the peak."""
    return claim("Uniform normal and shear stress along the bed joint is difficult to guarantee", "4",
                 f"standard deviation of the normal stress on the interfaces at the peak > {UNEVEN:.0%} of the "
                 "confinement",
                 "deviation, share of the interfaces in tension, share softened: "
                 + "; ".join(f"{label} {one.scatter / 1e6:.2f} MPa, {one.tension:.0%}, {one.softened:.0%}"
                 for label, (one, _) in even.items()),
                 all(one.scatter > UNEVEN * confinement for one, confinement in even.values()),
                 "it is uniform")  # fmt: skip
