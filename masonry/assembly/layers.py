"""Weight that comes on layer by layer, as a wall is built: one load a layer, and after them the tractions."""

import numpy as np

from geometry.blocks import Blocks
from masonry.model.layout import KINDS, Layout
from masonry.model.loads import Conditions, add_gravity
from masonry.scene import Scene


def lay_in_layers(scene: Scene, blocks: Blocks, layout: Layout, density: np.ndarray, into: Conditions) -> None:
    """Make the dead loads vary, in the order of assembly.schedule.in_layers: the weight of each layer from below, then
    each traction that stays; before the loads that vary anyway."""
    assert scene.gravity is not None
    gravity = np.array(scene.gravity.vector)
    layer = layer_of(blocks, layout, into, gravity, scene.gravity.layers)
    weights = {}
    for k in range(scene.gravity.layers):
        weights[f"gravity, layer {k + 1}"] = dict.fromkeys(KINDS)
        add_gravity(layout, weights[f"gravity, layer {k + 1}"], np.where(layer == k, density, 0.0), gravity)
    del into.each_load["gravity"]
    stay = [load for load in into.each_load.values() if not any(load is varying for varying in into.varying)]
    into.each_load = {**weights, **into.each_load}
    into.varying = [*weights.values(), *stay, *into.varying]
    into.load = dict.fromkeys(KINDS)


def layer_of(blocks: Blocks, layout: Layout, conditions: Conditions, gravity: np.ndarray, count: int) -> np.ndarray:
    """(B,) layer of each block, from 0 at the bottom: slices of equal height between the lowest and the highest corner
    of what can move, by the centroids."""
    up = -gravity / np.linalg.norm(gravity)
    moves = np.zeros(blocks.count, dtype=bool)
    for kind in KINDS:
        if layout.rows(kind):
            free = ~conditions.prescribed[kind].all(axis=1)
            moves[layout.owner[kind][free]] = True
    corner = blocks.points[blocks.face_points] @ up
    owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    low, high = corner[moves[owner]].min(), corner[moves[owner]].max()
    slices = np.floor((layout.centroid @ up - low) / (high - low) * count)
    return np.clip(slices, 0, count - 1).astype(np.int64)
