"""Did blocks turn on their beds? Contact points at the corners of patches alone resist that by up to 1.85 times what an
even pressure does; large displacement takes them where the scene chooses none.

Told where such turns make up a tenth of all sliding, by their work, the largest of them is 0.01 rad, and friction took
a tenth of the work: less does not change the answer.
"""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.edge_reach import points_are_chosen
from masonry.laboratory.remarks.inspection import Inspection
from masonry.monitors.collapse import Fallen
from masonry.results.deformation import BlockCorners, Deformation
from masonry.rows.history import Frame

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
    advice = 'take specimen.patch_points = "spread", or say "corners" where that does not matter'
    return [Doubt("turned_beds", share, MATTERS, sentence, advice)]


def turns_and_slides(assembly: Assembly, frames: list[Frame]) -> tuple[float, float, float]:
    """Sums over the faces of all joints without bonds that press, from frame to frame: pressing force (N) times how far
    their points moved by a turn about the normal (m), and by a slide; and the largest turn (rad) of any of them."""
    joints = assembly.joints
    first, face = np.unique(joints.patch, return_index=True, return_inverse=True)[1:]
    face, count = face.ravel(), len(first)
    area = np.bincount(face, joints.area, count)
    middle = np.column_stack([np.bincount(face, joints.area * x, count) for x in joints.point.T]) / area[:, None]
    lever = np.bincount(face, joints.area * np.linalg.norm(joints.point - middle[face], axis=1), count) / area
    a, b, n = joints.block_a[first], joints.block_b[first], joints.normal[first]
    dry, no_node = ~assembly.model.alive[first], np.full(count, -1)
    shape = BlockCorners(assembly.specimen.blocks)
    turn, before = np.zeros(count), None
    turned = slid = 0.0
    for frame in frames:
        field = Deformation(shape, frame)
        turned_by = np.eye(3) + field.gradient
        back = np.linalg.inv(turned_by[a])
        moved_a, moved_b = (field.at(one, middle, no_node) for one in (a, b))
        angle, apart = back @ turned_by[b], np.einsum("fij,fj->fi", back, moved_b - moved_a)
        thrust = np.where(dry, np.maximum(-np.bincount(face, joints.area * frame.normal_stress, count), 0.0), 0.0)
        if before is not None:
            spin = angle @ np.linalg.inv(before[0])
            axial = 0.5 * np.stack([spin[:, 2, 1] - spin[:, 1, 2], spin[:, 0, 2] - spin[:, 2, 0],
                                    spin[:, 1, 0] - spin[:, 0, 1]], axis=1)  # fmt: skip
            about = np.einsum("fi,fi->f", axial, n)
            slide = apart - before[1]
            slide -= np.einsum("fi,fi->f", slide, n)[:, None] * n
            force = np.minimum(thrust, before[2])
            turn += np.where(force > 0.0, about, 0.0)
            turned += float(np.sum(force * lever * np.abs(about)))
            slid += float(np.sum(force * np.linalg.norm(slide, axis=1)))
        before = angle, apart, thrust
    return turned, slid, float(np.abs(turn).max(initial=0.0))
