"""Blocks without a joint that meet during a run: nothing holds them apart, so the run stops and names both."""

from collections.abc import Mapping

import numpy as np

from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.intersect import are_convex
from geometry.polyhedra.measures import bounds, extent, face_areas_normals_centroids
from geometry.polyhedra.overlaps import overlapping_pairs, widest_gaps
from masonry.errors import Stopped
from masonry.model.model import Model
from masonry.monitors.corners import Corners
from masonry.runtime.state import State, attributes, put_back

DEEP = 1e-4
"""Share of the smaller block that an overlap needs to be one."""
DEEPER = 1e-2
"""The same for blocks that touched along an edge or in a corner from the beginning, where a little is a doubt only."""
TOUCHING = 1e-6
"""Share of the smaller block within which two blocks touch."""
CLOSURES = 3.0
"""Times the largest closure of any contact, up to which an overlap may be elastic: corners are squeezed like faces."""
REMEMBERED = ("met", "words")
FLAT = 1e-9
"""Share of the specimen within which the faces of a block are one plane, and the block is convex."""


class Collision:
    """Looks, at rows, whether blocks without a joint overlap by more than rounding, rotations and elasticity explain.

    What was apart must not meet. Blocks that touched along an edge or in a corner from the beginning, as across a
    crossing of joints, may come to lie on each other a little once joints slide: a doubt, and an end where it is deep.

    Candidates are the pairs whose boxes overlap once each is grown by how far its block may move; they are found anew
    when a block has left its grown box. What a face parted at the last look, and still parts, is not looked at closely.
    Where all blocks have joints with each other, nothing is done.
    """

    def __init__(self, model: Model, sets: Mapping[str, np.ndarray]) -> None:
        blocks, joints, layout = model.blocks, model.joints, model.layout
        self.blocks, self.sets = blocks, sets
        self.joined = np.unique(joints.block_a * blocks.count + joints.block_b)
        self.words = ""
        self.alone = 2 * len(self.joined) == blocks.count * (blocks.count - 1)
        if self.alone:
            return
        self.low, self.high = bounds(blocks)
        self.size = np.cbrt(layout.volume)
        self.radius = np.linalg.norm(self.high - self.low, axis=1)
        self.grown = np.full(blocks.count, -1.0)
        self.pairs = np.zeros((0, 2), dtype=np.int64)
        self.face = np.zeros(0, dtype=np.int64)
        self.owner, self.normal = blocks.face_block(), face_areas_normals_centroids(blocks)[1]
        self.convex = np.zeros(0, dtype=bool)
        self.corners = Corners(model)
        self.met = np.zeros(0, dtype=np.int64)

    def look(self, step: int, opening: np.ndarray, rotation: float) -> None:
        """Raise Stopped where two blocks overlap; opening (C,) m of all contacts, rotation: the largest so far, rad."""
        if self.alone:
            return
        moved, gradient = self.corners.moved()
        reach = np.abs(moved).max(axis=(0, 1))
        if np.any(reach > self.grown):
            self._find_candidates(reach)
        if len(self.pairs) == 0:
            return
        closed = CLOSURES * max(0.0, -float(opening.min(initial=0.0)))
        depth = DEEP * self.size[self.pairs].min(axis=1) + closed
        depth += 0.5 * rotation**2 * self.radius[self.pairs].max(axis=1)
        known = np.isin(self.codes, self.met)
        depth[known] += DEEPER * self.size[self.pairs[known]].min(axis=1)
        near = self._not_parted(self.corners.place + moved, gradient, depth)
        if len(near):
            self._look_closely(step, near, depth[near])

    def _find_candidates(self, reach: np.ndarray) -> None:
        """Pairs without a joint that can meet before a block has gone twice as far as now."""
        blocks = self.blocks
        self.grown = 2.0 * reach + DEEP * self.size
        grown = self.grown[:, None]
        pairs = overlapping_boxes(self.low - grown, self.high + grown)
        self.pairs = pairs[~np.isin(pairs @ [blocks.count, 1], self.joined)]
        if len(self.pairs) and len(self.convex) == 0:
            self.convex = are_convex(blocks, FLAT * extent(blocks))
        gap, self.face = widest_gaps(blocks, self.pairs)
        self.touching = gap <= TOUCHING * self.size[self.pairs].min(axis=1)
        self.codes = self.pairs @ [blocks.count, 1]

    def _not_parted(self, place: np.ndarray, gradient: np.ndarray, depth: np.ndarray) -> np.ndarray:
        """The candidates that neither their boxes nor the face between them, turned with its block, still parts."""
        low, high = place.min(axis=1), place.max(axis=1)
        a, b = self.pairs.T
        near = np.flatnonzero(np.all(np.minimum(high[:, a], high[:, b]) - np.maximum(low[:, a], low[:, b]) > depth, 0))
        one, normal = self.owner[self.face[near]], self.normal[self.face[near]]
        normal = normal - np.einsum("jin,nj->ni", gradient[:, :, one], normal)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        two = self.pairs[near].sum(axis=1) - one
        own, other = (np.einsum("ikn,ni->kn", place[:, :, side], normal) for side in (one, two))
        return near[other.min(axis=0) - own.max(axis=0) < -depth[near]]

    def _look_closely(self, step: int, near: np.ndarray, depth: np.ndarray) -> None:
        """Stop if these candidates overlap, or make it a doubt; if not, find the face that parts them now."""
        pairs, moved = self.pairs[near], self.corners.displaced()
        for one, two in overlapping_pairs(moved, pairs, depth, self.convex):
            low, high = (values[[one, two]] for values in bounds(moved))
            place = ", ".join(f"{x:.4g}" for x in (low.max(axis=0) + high.min(axis=0)) / 2)
            words = f"{self._name(one)} and {self._name(two)} meet around ({place}) m, where they have no joint"
            code = one * self.blocks.count + two
            if code in self.met or not self.touching[self.codes == code].all():
                raise Stopped(
                    f"step {step}: {words}; contacts are found once, before the run, so nothing would hold them apart: "
                    "end the drive before, or let them touch from the beginning"
                )
            self.met = np.append(self.met, code)
            self.words = self.words or f"{words}, from step {step} on"
        self.face[near] = widest_gaps(moved, pairs)[1]

    def state(self) -> State:
        """Which blocks met along edges so far."""
        return attributes(self, () if self.alone else REMEMBERED)

    def restore(self, state: State) -> None:
        """Go on from there."""
        put_back(self, () if self.alone else REMEMBERED, state)

    def _name(self, block: int) -> str:
        """What a scene calls a block: the smallest of its sets that holds it, with its number where that holds more."""
        holding = {name: len(members) for name, members in self.sets.items() if block in members}
        if not holding:
            return f"block {block} (unit {self.blocks.unit[block]})"
        name = min(holding, key=lambda name: holding[name])
        return f"'{name}'" if holding[name] == 1 else f"block {block} of '{name}'"
