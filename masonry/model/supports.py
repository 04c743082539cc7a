"""Blocks or faces that supports and the drive hold, and the dofs that this means."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.boundary import surface_nodes
from geometry.polyhedra import measures
from masonry.errors import SceneError
from masonry.model.layout import ALONG, Layout
from masonry.model.loads import no_conditions


@dataclass(frozen=True)
class Hold:
    """Blocks (or, where `faces` is given, outer faces of them) that are held: axes 0..2, rotations if rigid."""

    blocks: np.ndarray
    axes: tuple[int, ...]
    rotations: tuple[int, ...] = ()
    faces: np.ndarray | None = None
    name: str = "support"


def held_dofs(blocks: Blocks, layout: Layout, hold: Hold) -> dict[str, np.ndarray]:
    """Per kind, a mask of the dofs that a support or drive takes hold of.

    A whole block: each named axis holds its movement and (affine) the strains along it; turns are for rigid blocks.
    A face: nodes of tets; a rigid block's face can be a roller (its normal) or be held altogether.
    """
    masks = no_conditions(layout).prescribed
    if hold.faces is not None:
        return _held_faces(blocks, layout, hold, masks)
    rigid = layout.local[layout.of_kind(hold.blocks, "rigid")]
    affine = layout.local[layout.of_kind(hold.blocks, "affine")]
    for axis in hold.axes:
        masks["rigid"][rigid, axis] = True
        masks["affine"][affine, axis] = True
        masks["affine"][affine, 3 + 3 * axis : 6 + 3 * axis] = True
    if set(hold.rotations) == {0, 1, 2}:
        masks["rigid"][rigid, 3:] = True
    else:
        for block in layout.of_kind(hold.blocks, "rigid") if hold.rotations else ():
            masks["rigid"][layout.local[block], 3:] |= _held_rotations(layout, block, hold)
    if layout.mesh is not None:
        for b in hold.blocks:
            masks["tets"][layout.mesh.node_start[b] : layout.mesh.node_start[b + 1], list(hold.axes)] = True
    return masks


def _held_rotations(layout: Layout, block: int, hold: Hold) -> np.ndarray:
    """(3,) which turns of a rigid block are held: one about a principal axis, or both that leave one about it."""
    if len(hold.rotations) == 1:
        return np.arange(3, 6) == _rotation_dof(layout, block, hold.rotations[0], hold)
    (free,) = {0, 1, 2}.difference(hold.rotations)
    return np.arange(3, 6) != _rotation_dof(layout, block, free, hold)


def _held_faces(blocks: Blocks, layout: Layout, hold: Hold, masks: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    assert hold.faces is not None
    owner = blocks.face_block()[hold.faces]
    normal = measures.face_areas_normals_centroids(blocks)[1][hold.faces]
    for face_owner, n in zip(owner, normal, strict=True):
        if layout.meshed[face_owner]:
            continue
        if layout.deforms[face_owner]:
            raise SceneError(
                f"{hold.name}: a face of an affine block cannot be held alone; hold the whole block, "
                "put a rigid plate there, or use tets"
            )
        _hold_rigid_face(masks["rigid"][layout.local[face_owner]], hold, n, layout, int(face_owner))
    meshed = hold.faces[layout.meshed[owner]]
    if layout.mesh is not None and len(meshed):
        nodes, _ = surface_nodes(layout.mesh, blocks, meshed)
        for axis in hold.axes:
            masks["tets"][nodes, axis] = True
    return masks


def _hold_rigid_face(row: np.ndarray, hold: Hold, normal: np.ndarray, layout: Layout, block: int) -> None:
    along = int(np.argmax(np.abs(normal)))
    if set(hold.axes) == {0, 1, 2}:
        row[:] = True
    elif hold.axes == (along,):
        row[along] = True
        row[3:] |= np.arange(3, 6) != _rotation_dof(layout, block, along, hold)
    else:
        raise SceneError(
            f"{hold.name}: the face of a rigid block can be a roller (fix '{'xyz'[along]}', its normal) or be held "
            "altogether (fix 'all'); anything else: hold the whole block"
        )


def _rotation_dof(layout: Layout, block: int, axis: int, hold: Hold) -> int:
    """Which dof (3, 4 or 5) of a rigid block is its turn about x, y or z, which has to be a principal axis."""
    if abs(layout.axes[block, axis, axis]) < ALONG:
        place = ", ".join(f"{x:.4g}" for x in layout.centroid[block])
        axes = " and ".join("xyz"[k] for k in hold.rotations) or "the other two axes"
        raise SceneError(
            f"{hold.name}: {'xyz'[axis]} is no principal axis of rigid block {block} at ({place}) m, so its turn about "
            f"{axes} cannot be held alone: fix 'rotation' or 'all', or put a rigid plate there"
        )
    return 3 + axis
