"""Settings of a drive to an accuracy: each number once, with its unit and its reason."""

from dataclasses import dataclass

from masonry.rows.rest_criterion import FOLLOWED, RestCriterion


@dataclass(frozen=True)
class AdaptiveSettings:
    """Settings of AdaptiveLoading. Those under "bounds" are in accuracies; benchmarks/test_controlled.py measures them.

    settling_rows      one in so many of the rows goes to the settling, which nobody looks at but for its end
    steps              steps of an increment: about a period of the slowest swing of a wallette
    few_steps, still   the same where all that moves is prescribed; kinetic over stored energy below which it is so
    looks              at an increment whose force may be the highest, to tell what of it is borne
    curve              accuracy of increments there, at one of `fine` or coarser: only the curve is followed
    coarsest, finest   increments in which the whole displacement is made, at least and at most
    first              share of the displacement that the first increment makes
    parting, shortest  where patches may part, the same over the deepest overlap of blocks under the dead loads, and the
                       least increment over the path so far; both at an accuracy of `parts` or coarser, and as much
                       finer as that is
    lifts              accuracies by which the force of the drive may change there, over the largest: a block that lifts
                       off sets out with a jerk, and the drive bears a share of its weight too much that goes with the
                       speed: 0.2 (stocky) to 0.45 (slender) of the increment over the overlap
    steady             share of the kinetic energy that was expected, from which on the drive bears as much
                       as it would at rest
    learning           increments before the speed may rise
    intact             nothing counts as damaged while fracture has taken less than this share of the stored energy
    rise, fall         most and least change of the speed from one increment to the next, while all is elastic
    approach           share of the path to the first damage, slip or opening that an increment may make, unless it is
                       as short as the accuracy anyway
    faster, slower     most and least change of the speed from then on

    Bounds on what an increment may bring:
    stored, fracture   change of the stored energy, and energy dissipated by fracture, over the most that was stored
    lag                energy by which the drive runs ahead, over the work of the drive
    sway               root of kinetic over stored energy
    rises              change of the force of the drive over the largest, where contacts are dry
    ends, drag         difference between the forces of the two ends, and the force that damping takes on average (its
                       work over the path), over the largest force

    inertia            force that inertia and damping take or give, over the largest

    Sudden cracks:
    unexpected         share of the kinetic energy that was not expected, from which on the drive is held
    rest               it goes on when the specimen rests, one look an increment
    longest_hold       or after so many increments

    fine, blunt        accuracies coarser than `fine` are taken for (accuracy / fine) ** blunt of it, as sudden cracks
                       would be overrun
    deformable         share of the accuracy that is aimed at where units deform: the same bounds left 2.4 (affine) and
                       4.8 % (tets) of error in the dissipated energy of mode 1 at an accuracy of 1 %, and 0.7 % with
                       rigid units
    """

    settling_rows: int = 10
    steps: int = 80
    few_steps: int = 4
    still: float = 1e-12
    looks: int = 4
    curve: float = 0.05
    coarsest: int = 30
    finest: int = 40_000
    first: float = 1e-4
    parting: float = 0.1
    shortest: float = 1e-3
    parts: float = 0.05
    lifts: float = 0.25
    steady: float = 0.99
    learning: int = 4
    intact: float = 1e-6
    rise: float = 2.0
    fall: float = 0.1
    approach: float = 0.4
    faster: float = 1.3
    slower: float = 0.2
    stored: float = 20.0
    fracture: float = 5.0
    lag: float = 1.0
    sway: float = 7.0
    rises: float = 1.0
    ends: float = 0.4
    drag: float = 0.5
    inertia: float = 3.0
    unexpected: float = 0.5
    rest: RestCriterion = FOLLOWED
    longest_hold: int = 600
    fine: float = 0.01
    blunt: float = 0.4
    deformable: float = 0.5


SETTINGS = AdaptiveSettings()
"""As runs have them; a study hands others to AdaptiveLoading."""
