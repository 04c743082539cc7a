"""The claims on a crack through head joints and units: strength, straightness, place in its units, no sliding."""

from collections.abc import Mapping

import numpy as np

from masonry.laboratory.result import Result
from masonry.pictures.style import MILLI
from verification.paper.experiment import Claim, claim
from verification.paper.walls.common import crack_spread, where
from verification.paper.walls.crack_path import crack_path

ALL_AT_PEAK = 0.225
"""MPa: head joints and units of one section at their tensile strengths at once."""
HALF_UNIT = 0.125
"""m: the farthest that a crack can be from the middle of its unit."""
STRAIGHT = 0.025
"""m: a tenth of a unit; a stepped crack has a spread of a quarter of one."""


def peak_claim(peaks: Mapping[str, float]) -> Claim:
    """Peaks in MPa by run, below what one section can carry."""
    low, high = min(peaks.values()), max(peaks.values())
    return claim("The capacity is that of head joints and units in one section", "limit analysis",
                 f"every peak <= {ALL_AT_PEAK} MPa, all of a section at its strength",
                 f"{low:.4f} to {high:.4f} MPa in {len(peaks)} runs",
                 high <= ALL_AT_PEAK, "more than the section can carry")  # fmt: skip


def path_claims(results: Mapping[str, Result]) -> list[Claim]:
    """Course of the crack through joints and units, and its place in the units."""
    fractions = {label: crack_path(r).fractions() for label, r in results.items()}
    spread = {label: crack_spread(r) for label, r in results.items()}
    distance = {label: crack_path(r).off_mid_length() for label, r in results.items()}
    return [
        claim("The cracks follow the head joints and the bricks", "5.2, Fig. 14",
              "broken: head joints > 0.4 and units > 0.25 of the section, bed joints < 0.15",
              "; ".join(f"{label}: {s['head joints']:.2f}, {s['units']:.2f}, {s['bed joints']:.2f}"
                  for label, s in fractions.items()),
              all(s["head joints"] > 0.4 and s["units"] > 0.25 and s["bed joints"] < 0.15 for s in fractions.values()),
              "another path"),
        claim("Roughly through the mid-length of the brick", "5.2, Fig. 14",
              f"mean distance from it < a fifth of half a unit ({200 * HALF_UNIT:.0f} mm); spread < "
              f"{STRAIGHT * MILLI:.0f} mm",
              "; ".join(f"{label}: {distance[label] * MILLI:.0f} mm, crack at {where(r)} mm"
                  for label, r in results.items()),
              max(distance.values()) < 0.2 * HALF_UNIT and max(spread.values()) < STRAIGHT, "beside the middle"),
    ]  # fmt: skip


def sliding_claim(results: Mapping[str, Result]) -> Claim:
    """Head joints open, and do not slide."""
    slip = {label: crack_path(r).head_joint_slip() for label, r in results.items()}
    return claim("No sliding (or shear) failure at the head joints", "6, Fig. 18",
                 "largest slip at broken head joints < 5 % of the largest opening there",
                 "; ".join(f"{label}: {100 * s:.1f} %" for label, s in slip.items()),
                 float(np.max(list(slip.values()))) < 0.05, "they slide")  # fmt: skip
