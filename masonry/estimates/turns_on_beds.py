"""How far blocks turned on their beds, and how far they slid."""

import numpy as np

from geometry.joints.faces.whole_faces import middles
from masonry.assembly.assemble import Assembly
from masonry.results.deformation import BlockCorners, Deformation
from masonry.rows.history import Frame


def turns_and_slides(assembly: Assembly, frames: list[Frame]) -> tuple[float, float, float]:
    """Sums over the faces of all joints without bonds that press, from frame to frame: pressing force (N) times how far
    their points moved by a turn about the normal (m), and by a slide; and the largest turn (rad) of any of them."""
    joints = assembly.joints
    first, face = np.unique(joints.patch, return_index=True, return_inverse=True)[1:]
    face, count = face.ravel(), len(first)
    area, middle = middles(joints, face, count)
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
