"""What blocks and joints come to, to be held against the drawing: volumes, joint areas, head joints, gaps."""

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.overlaps import check_overlaps


def joint_areas(joints: Joints) -> dict[tuple[int, int], float]:
    """m2 that two blocks share, by their numbers."""
    found: dict[tuple[int, int], float] = {}
    for a, b, area in zip(joints.block_a.tolist(), joints.block_b.tolist(), joints.area.tolist(), strict=True):
        found[a, b] = found.get((a, b), 0.0) + area
    return found


def area_across(joints: Joints, axis: int) -> float:
    """m2 of all joints that look along an axis."""
    return float(joints.area[np.abs(joints.normal[:, axis]) > 1 - 1e-9].sum())


def surface(blocks: Blocks) -> float:
    """m2 of all faces."""
    from geometry.polyhedra.measures import face_areas_normals_centroids

    return float(face_areas_normals_centroids(blocks)[0].sum())


def head_joint_lines(specimen: Specimen, set_name: str, axis: int) -> list[tuple[float, float]]:
    """(place along the axis, z of the middle) of every upright joint between units of a set, a course high."""
    members = set(specimen.sets[set_name].tolist())
    joints = find_joints(specimen.blocks)
    first = np.unique(joints.patch, return_index=True)[1]
    middle = np.array(
        [joints.patch_points[joints.patch_start[k] : joints.patch_start[k + 1]].mean(axis=0) for k in range(len(first))]
    )
    return [
        (float(middle[k][axis]), float(middle[k][2]))
        for k, n in enumerate(first)
        if abs(joints.normal[n][axis]) > 1 - 1e-9 and {int(joints.block_a[n]), int(joints.block_b[n])} <= members
    ]


def require_bond(specimen: Specimen, set_name: str, axis: int, rise: float, lap: float) -> None:
    """No head joint of a course stands nearer than a lap (m) to one of the next course."""
    lines = np.array(head_joint_lines(specimen, set_name, axis))
    course = np.floor(lines[:, 1] / rise + 1e-9)
    assert len(np.unique(course)) > 2
    for c in np.unique(course):
        above = lines[course == c + 1, 0]
        for place in lines[course == c, 0]:
            assert not len(above) or np.abs(above - place).min() >= lap - 1e-9, (place, c)


def require_sound(specimen: Specimen, volume: float) -> None:
    """The blocks fill this volume (m3) to 1e-9, none overlaps another, and each unit is one block or its parts."""
    check_overlaps(specimen.blocks)
    assert abs(volumes(specimen.blocks).sum() / volume - 1) < 1e-9
    low, high = bounds(specimen.blocks)
    assert (high > low).all()
