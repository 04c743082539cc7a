"""May joints rock about points within their edges? A run says so of joints that did."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.estimates.joint_faces import Faces, faces_of
from masonry.laboratory.remarks.edge_reach import is_dry, reach_along, rocking
from masonry.laboratory.remarks.hinges import axes_of_turns

FREE = 1e-6
"""Of a unit vector: a part of an axis across the normal of a joint below bends it by nothing."""


def remarks(assembly: Assembly) -> list[str]:
    """A line for each contact group with such joints."""
    joints = assembly.joints
    dry = [g for g in range(len(assembly.model.group_names)) if is_dry(assembly, g)]
    if not len(joints.area) or not dry:
        return []
    faces, turns = faces_of(assembly), axes_of_turns(assembly)
    first, reach = faces.order[faces.start[:-1]], np.full(len(faces.area), np.inf)
    for face in np.flatnonzero(np.isin(faces.group, dry)):
        for block in (joints.block_a[first[face]], joints.block_b[first[face]]):
            along = _openings(faces, int(face), turns[block])
            reach[face] = min(reach[face], reach_along(faces, int(face), along))
    return [doubt.line for doubt in rocking(assembly, faces, reach, "turn, where they rock,")]


def _openings(faces: Faces, face: int, axes: np.ndarray) -> np.ndarray:
    """(D, 3) the directions along which a face may open as a block turns about axes (3, 3): across each of its edges,
    where it may turn about both axes in its plane."""
    normal = faces.normal[face]
    across = np.cross(normal, axes)
    _, sizes, directions = np.linalg.svd(across)
    free = directions[sizes > FREE]
    if len(free) < 2:
        return np.concatenate([free, -free])
    edges = np.concatenate([np.roll(corners, -1, axis=0) - corners for corners in faces.polygons[face]])
    along = np.cross(normal, edges)
    return np.concatenate([along, -along])
