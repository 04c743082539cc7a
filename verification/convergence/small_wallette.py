"""Two courses of a wall, pulled along the bed joints: the wallette of failure mode 2 with an eighth of its blocks.

No closed form: the reference is the same wall at the slowest constant rate, with what it may still be off by
(Richardson's extrapolation over three rates, and the difference from the finest drive to an accuracy).
"""

from verification.problem import ACCURACY, RATE, Problem, Refinement, accuracies, dampings, fractions, laws

BASE = {"specimen.courses": 2, "specimen.divisions": [4, 2], "drive.displacement": "0.2 mm"}
RATES = ("4", "2", "1", "0.5", "0.25", "0.125", "0.0625")
QUICK = {"drive.rate": "0.5 mm/s"}


def rates() -> Refinement:
    """Constant rates, each half the one before."""
    return {f"{rate} mm/s": {"drive.rate": f"{rate} mm/s"} for rate in RATES}


PROBLEMS = (
    Problem(
        "small-wallette",
        "Wallette of two courses",
        "wallette-mode-2",
        {
            RATE: rates(),
            ACCURACY: accuracies(),
            "step fraction": fractions(QUICK),
            "damping": dampings(QUICK),
            "model: law": laws(QUICK),
        },
        base=BASE,
    ),
)
