"""Whether a specimen is at rest: one criterion, and its levels, from where nothing is doubted to where nothing moves.

A swing whose force is a share s of what the specimen bears has the share s^2 of what it stores as kinetic energy. What
slides or falls slowly is told from a rest by its energy: it gains speed, while the force that drives it may be small.
"""

from math import inf
from typing import NamedTuple

from masonry.rows.columns import stored_in

LONE = 10.0
"""Times by which the force on one block may exceed the share that is asked of the sum over all, and by its square the
energy: where all swing together some swing more than the mean; what falls alone exceeds that within some looks."""


class RestCriterion(NamedTuple):
    """All together are at rest below both shares, in so many looks on end.

    force   that accelerates, over the dead loads; infinite where it is not asked for
    energy  of motion, over what the specimen stores
    """

    force: float
    energy: float
    looks: int = 1

    @property
    def of_block(self) -> "RestCriterion":
        """The same of one block: over what it bears, and what it stores."""
        return RestCriterion(LONE * self.force, LONE**2 * self.energy, self.looks)

    def with_share(self, share: float) -> "RestCriterion":
        """With a share of the force."""
        return self._replace(force=self.force * share)

    def holds(self, force: float, energy: float) -> bool:
        """Whether such shares are a rest."""
        return force <= self.force and energy <= self.energy


DOUBTED = RestCriterion(1e-3, 1e-6)
"""With more, the numbers of a run are doubted: a specimen whose forces balance to a thousandth is within a thousandth
of its answer. Below it, blocks are looked at one by one."""
SETTLED = RestCriterion(1e-4, 1e-8, looks=5)
"""The dead loads have settled, where the scene does not say in how many steps: in the last looks of a trial, as the
forces of a swing vanish at its middle."""
BORNE = RestCriterion(1e-2, 1e-8, looks=4)
"""A load that grows is borne; the force is over the accuracy."""
FOLLOWED = RestCriterion(inf, 1e-7, looks=4)
"""A drive to an accuracy goes on after a sudden crack; a look is an increment."""
BRAKED = RestCriterion(inf, 1e-7, looks=20)
"""A drive at a rate or in steps goes on after a sudden crack; a look is a braking, as a crack may creep on before it
leaps."""
ENDED = RestCriterion(inf, 1e-8, looks=20)
"""A run ends that was to end at rest; a look is a row, and the energy is over the largest of motion so far, of one
block over its part of that: what turns round in the air is still for less than a row."""

LEAST_STORED = 1e-6
"""Share of the external work that counts as stored at least, where kinetic energy is held against what is stored."""


def still_moving(terms: dict[str, float]) -> float:
    """Kinetic energy over what the specimen stores, by its ledger (J)."""
    stored = abs(stored_in(terms))
    return abs(terms["kinetic"]) / max(stored, LEAST_STORED * abs(terms["external_work"]), 1e-300)
