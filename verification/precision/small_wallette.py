"""Two courses of a wall, pulled along the bed joints: the wallette of failure mode 1 with a quarter of its blocks.

No closed form: the reference is the same wall at the slowest constant rate, with what it may still be off by
(Richardson's extrapolation over three rates).
"""

from verification.ladder import ACCURACY, RATE, Problem, Rungs, accuracies, dampings, fractions

BASE = {"specimen.courses": 2, "specimen.divisions": [4, 2], "drive.displacement": "0.3 mm"}
RATES = ("16", "8", "4", "2", "1", "0.5")
QUICK = {"drive.rate": "4 mm/s"}


def rates() -> Rungs:
    """Constant rates, each half the one before."""
    return {f"{rate} mm/s": {"drive.rate": f"{rate} mm/s"} for rate in RATES}


PROBLEMS = (
    Problem(
        "small-wallette",
        "Wallette of two courses",
        "wallette-mode-1",
        {
            RATE: rates(),
            ACCURACY: accuracies(),
            "step fraction": fractions(QUICK),
            "damping": dampings(QUICK),
        },
        base=BASE,
    ),
)
