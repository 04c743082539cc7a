"""Did blocks turn on their beds? Contact points at the corners of patches alone resist that by up to 1.85 times what an
even pressure does; large displacement takes them where the scene chooses none.

Told where such turns make up a tenth of all sliding, by their work, the largest of them is 0.01 rad, and friction took
a tenth of the work: less does not change the answer.
"""

import numpy as np

from masonry.estimates.inspection import Inspection
from masonry.estimates.turns_on_beds import turns_and_slides
from masonry.judgement.doubt import POINTS, Doubt
from masonry.laboratory.remarks.bending_points import SPREAD, points_are_chosen
from masonry.monitors.collapse import Fallen

TURNED, MATTERS = 0.01, 0.1
"""rad, about the normal of a joint; share of the sliding, and of the work."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most, of what was until a block fell."""
    assembly, outcome, frames = inspection.assembly, inspection.outcome, inspection.frames
    if not assembly.scene.is_large or points_are_chosen(inspection.assembly) or len(frames) < 2:
        return []
    rows, fallen = outcome.history.rows, outcome.records.get(Fallen)
    frames = [frame for frame in frames if fallen is None or frame.step <= fallen.step]
    work = max(float(np.abs(rows[key]).max()) for key in ("external_work", "kinetic"))
    if not len(assembly.joints.area) or float(rows["friction"].max()) < MATTERS * work:
        return []
    turned, slid, most = turns_and_slides(assembly, frames)
    if most < TURNED or turned < MATTERS * (turned + slid):
        return []
    share = turned / (turned + slid)
    sentence = (
        f"blocks turned on their beds: these turns are about {100 * share:.0f} % of all sliding, and contact points at "
        "the corners alone resist them by up to 1.85 times what an even pressure does"
    )
    return [Doubt("turned_beds", share, MATTERS, sentence, SPREAD, POINTS)]
