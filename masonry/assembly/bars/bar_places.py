"""Which block holds each end of a bar. An end lies in one block, or stays in space where the scene says so."""

import numpy as np

from geometry.blocks import Blocks, Specimen
from geometry.polyhedra.line_cuts import TOUCH, pieces, planes_of
from geometry.polyhedra.measures import extent
from masonry.detection.tet_pieces import FACES
from masonry.elements.bars.bar_element import BarPlaces
from masonry.errors import SceneError
from masonry.model.large.block_motion import outer_tets
from masonry.model.layout import Layout
from masonry.scene import Scene

ENDS = ("first", "second")


def bar_places_of(scene: Scene, specimen: Specimen, layout: Layout) -> BarPlaces:
    """The bars of a scene, in the order of its tables.

    Raises SceneError for an end that no block holds, or two do, or that lies inside of a block of tets.
    """
    table = np.repeat(np.arange(len(scene.bar)), [bar.repeat for bar in scene.bar])
    point = np.array([place for bar in scene.bar for place in bar.places])
    still = np.array([[bar.fixed_end == end for end in ENDS] for bar in scene.bar])[table]
    block = np.full(still.shape, -1)
    node, fraction = np.full((*still.shape, 3), -1), np.zeros((*still.shape, 3))
    planes = planes_of(specimen.blocks)
    reach = extent(specimen.blocks)
    for k, end in zip(*np.nonzero(~still), strict=True):
        where, place = f"bar.{table[k]}.ends", point[k, end]
        block[k, end] = _block_at(specimen.blocks, planes, place, TOUCH * reach, f"{where}: the {ENDS[end]} end")
        if layout.meshed[block[k, end]]:
            node[k, end], fraction[k, end] = _nodes_at(layout, block[k, end], place, TOUCH * reach, where)
    most = np.array([np.inf if bar.yield_force is None else bar.yield_force for bar in scene.bar])
    least = np.where([bar.compression for bar in scene.bar], -most, 0.0)
    numbers = np.array([[bar.stiffness, bar.slack, bar.pretension] for bar in scene.bar])[table]
    names = [name for bar in scene.bar for name in bar.names or [None] * bar.repeat]
    return BarPlaces(
        *(block, point, node, fraction, numbers[:, 0].copy(), least[table], most[table]),
        *(numbers[:, 1].copy(), numbers[:, 2].copy(), {name: k for k, name in enumerate(names) if name is not None}),
    )


def _block_at(blocks: Blocks, planes: tuple[np.ndarray, np.ndarray], place: np.ndarray, width: float, what: str) -> int:
    """The block that a point lies in."""
    holding = pieces(*planes, place.tolist(), width).body
    where = f"({', '.join(f'{x:.6g}' for x in place)}) m"
    if len(holding) == 1:
        return int(holding[0])
    if len(holding) > 1:
        names = " and ".join(_words(blocks, int(block)) for block in holding[:2])
        raise SceneError(f"{what} at {where} lies in the joint of {names}: move it into the block that holds it")
    off = (np.einsum("bni,i->bn", planes[0], place) - planes[1]).max(axis=1)
    nearest = int(np.argmin(off))
    raise SceneError(
        f"{what} at {where} lies in no block; the nearest, {_words(blocks, nearest)}, is {off[nearest]:.3g} m away. An "
        "end that stays in space, as in rock, is named by fixed_end = 'first' or 'second'"
    )


def _words(blocks: Blocks, block: int) -> str:
    return f"block {block} ({blocks.groups[blocks.group[block]]})"


def _nodes_at(layout: Layout, block: int, place: np.ndarray, width: float, where: str) -> tuple[np.ndarray, np.ndarray]:
    """Three nodes (3,) of a triangle at the surface of a block of tets, and their shares (3,) of a point there."""
    tets = outer_tets(layout)
    assert tets is not None and layout.mesh is not None
    own = np.flatnonzero(tets.block == block)
    tet, face = np.nonzero(tets.outer[own])
    nodes = tets.node[own[tet][:, None], np.array(FACES)[face]]
    corner = layout.mesh.nodes[nodes]
    first, second = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    normal, arm = np.cross(first, second), place - corner[:, 0]
    square = np.einsum("ti,ti->t", normal, normal)
    share = np.column_stack(
        [np.einsum("ti,ti->t", np.cross(arm, second), normal), np.einsum("ti,ti->t", np.cross(first, arm), normal)]
    )
    share = share / square[:, None]
    share = np.column_stack([1.0 - share.sum(axis=1), share])
    outside = np.clip(share, 0.0, 1.0)
    outside /= outside.sum(axis=1, keepdims=True)
    miss = np.linalg.norm(np.einsum("tn,tni->ti", outside, corner) - place, axis=1)
    best = int(np.argmin(miss))
    if miss[best] > 10.0 * width:
        at = ", ".join(f"{x:.6g}" for x in np.einsum("n,ni->i", outside[best], corner[best]))
        raise SceneError(
            f"{where}: blocks of kinematics 'tets' hold bars at their surface; the nearest place there is ({at}) m"
        )
    return nodes[best], outside[best]
