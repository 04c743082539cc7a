"""Joints with one row of contact points: they bear no moment about it, and turn there as hinges do."""

from typing import NamedTuple

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.configuration.parts.parts import parts_of
from masonry.estimates.joint_faces import Faces, corners_of
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.edge_reach import is_dry

SLIVER = 1e-3
"""Depth of a joint over the root of its area, below which it bears no moment whatever its points are."""
ENOUGH = 4
"""Points along an edge that are proposed; a run with them says whether these do."""
ABOUT = 1e-6
"""Cosine from which on an axis is not at right angles to another."""


class Hinges(NamedTuple):
    """The H joint faces that have one row of contact points, or one point.

    face  (H,) their places among all faces
    bare  (H, 3, 3) onto the directions in the face along which they have points at one place only
    dry   (H,) whether they have no tension
    """

    face: np.ndarray
    bare: np.ndarray
    dry: np.ndarray


def hinges_of(assembly: Assembly, faces: Faces) -> Hinges:
    """All of a specimen, but dry joints in large displacement: their points are those of patches."""
    model = assembly.model
    dry = np.array([is_dry(assembly, group) for group in range(len(model.group_names))], dtype=bool)[faces.group]
    second = faces.sums(assembly.joints.area[:, None, None] * faces.arm[:, :, None] * faces.arm[:, None, :])
    flat = np.eye(3) - faces.normal[:, :, None] * faces.normal[:, None, :]
    bare = flat - faces.inverse @ second
    face = np.flatnonzero((~dry | (not assembly.scene.is_large)) & (np.trace(bare, axis1=1, axis2=2) > 0.5))
    wide = np.zeros(len(face), dtype=bool)
    for number, k in enumerate(face):
        across = (corners_of(faces, int(k)) - faces.middle[k]) @ bare[k]
        wide[number] = np.linalg.norm(np.ptp(across, axis=0)) > SLIVER * faces.area[k] ** 0.5
    return Hinges(face[wide], bare[face[wide]], dry[face[wide]])


def free_hinges(assembly: Assembly, faces: Faces, hinges: Hinges) -> list[Doubt]:
    """One for each contact group with such joints between blocks that may turn about them; of dry ones `rocking` of
    `edge_reach.py` says so."""
    model = assembly.model
    first = faces.order[faces.start[hinges.face]]
    turns, count = axes_of_turns(assembly), np.zeros(len(model.group_names), dtype=int)
    for face, bare, dry, contact in zip(*hinges, first, strict=True):
        about = np.cross(faces.normal[face], bare.T)  # (3, 3), of which each row is an axis
        joined = assembly.joints.block_a[contact], assembly.joints.block_b[contact]
        if not dry and any((np.abs(turns[block] @ about.T) > ABOUT).any() for block in joined):
            count[faces.group[face]] += 1
    return [
        Doubt(
            "free_hinges",
            None,
            None,
            f"contact.{name}: {number} joint{'s have' if number > 1 else ' has'} one row of contact points, and bear"
            f"{'s' if number == 1 else ''} no moment where blocks turn about it",
            more_points(assembly),
        )
        for name, number in zip(model.group_names, count, strict=True)
        if number
    ]


def axes_of_turns(assembly: Assembly) -> np.ndarray:
    """(B, 3, 3): the rows are axes about which each block is free to turn; 0 where it is not."""
    model, free = assembly.model, np.zeros((assembly.specimen.blocks.count, 3, 3))
    for part in parts_of(model):
        free[part.blocks] = part.turns_about()
    return free


def more_points(assembly: Assembly) -> str:
    """The key that the scene has taken for the number of points."""
    specimen = assembly.scene.specimen
    if specimen.points_per_face is not None:
        return f"take specimen.points_per_face = {ENOUGH**2} or more"
    if specimen.contact_spacing is not None:
        return f"take a specimen.contact_spacing of 1/{ENOUGH} of the edges, or less"
    return f"take specimen.points_per_edge = {ENOUGH} or more"
