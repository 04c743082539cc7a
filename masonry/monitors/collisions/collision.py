"""Blocks without a joint that meet during a run: nothing holds them apart, so the run stops and names both."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from geometry.blocks import Blocks
from geometry.jit_cache import compiled
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.intersect import are_convex
from geometry.polyhedra.measures import bounds, extent, face_areas_normals_centroids
from geometry.polyhedra.overlaps import overlap, widest_gaps
from masonry.errors import MovedTooFar
from masonry.model.model import Model
from masonry.monitors.collisions.block_corners import Corners, move
from masonry.monitors.frames import compile_frame
from masonry.monitors.observer import Observer, View

DEEP = 1e-4
"""Share of the smaller block that an overlap needs to be one."""
DEEPER = 1e-2
"""The same for blocks that touched along an edge or in a corner from the beginning, where a little is a doubt only."""
ROOM = 1e-2
"""Share of a block by which its box is grown at least, so that candidates are not found anew at every little motion."""
TOUCHING = 1e-6
"""Share of the smaller block within which two blocks touch."""
CLOSURES = 3.0
"""Times the largest closure of any contact, up to which an overlap may be elastic: corners are squeezed like faces."""
FLAT = 1e-9
"""Share of the specimen within which the faces of a block are one plane, and the block is convex."""


@dataclass(frozen=True)
class Met:
    """In words, what met in the run, and what lies on each other at its end; "" where nothing does."""

    words: str
    at_end: str


class Collision(Observer):
    """Looks, at rows, whether blocks without a joint overlap by more than rounding, rotations and elasticity explain.

    What was apart must not meet. Blocks that touched along an edge or in a corner from the beginning, as across a
    crossing of joints, may come to lie on each other a little once joints slide: a doubt, and an end where it is deep.

    Candidates are the pairs whose boxes overlap once each is grown by how far its block may move; they are found anew
    when a block has left its grown box. What an axis parted at the last look, normal to a face or across two edges, and
    still parts, is not looked at closely. Where all blocks have joints with each other, nothing is done.
    """

    REMEMBERED = ("met", "words")

    def __init__(self, model: Model, sets: Mapping[str, np.ndarray]) -> None:
        blocks, layout = model.blocks, model.layout
        self.blocks, self.sets = blocks, sets
        self.joined = joined_pairs(model)
        self.words, self.last, self.met = "", "", np.zeros(0, dtype=np.int64)
        self.alone = are_all_joined(self.joined, blocks)
        if self.alone:
            return
        self.low, self.high = bounds(blocks)
        self.size = np.cbrt(layout.volume)
        self.radius = np.linalg.norm(self.high - self.low, axis=1)
        self.grown = np.full(blocks.count, -1.0)
        self.pairs = np.zeros((0, 2), dtype=np.int64)
        self.owner, self.normal = blocks.face_block(), face_areas_normals_centroids(blocks)[1]
        self.convex = np.zeros(0, dtype=bool)
        self.corners = Corners(model)

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        """Raise MovedTooFar where two blocks overlap."""
        if not self.alone:
            self._look(step, view.seen.opening, view.rotation)
        return {}

    def records(self) -> list[Any]:
        return [Met(self.words, self.last)]

    def _look(self, step: int, opening: np.ndarray, rotation: float) -> None:
        """Opening (C,) m of all contacts, rotation: the largest so far, rad."""
        place, reach, gradient = self.corners.now()
        if (reach > self.grown).any():
            self._find_candidates(reach)
        if len(self.pairs) == 0:
            return
        depth = np.empty(len(self.pairs))
        write_depths(opening, 0.5 * rotation**2, self.least, self.larger, depth)
        if len(self.met):
            depth += DEEPER * self.smaller * np.isin(self.codes, self.met)
        near = self._not_parted(place, gradient, depth)
        if len(near):
            self._look_closely(step, near, depth[near], gradient)

    def _find_candidates(self, reach: np.ndarray) -> None:
        """Pairs without a joint that can meet before a block has gone twice as far as now."""
        blocks = self.blocks
        self.grown = 2.0 * reach + ROOM * self.size
        grown = self.grown[:, None]
        pairs = overlapping_boxes(self.low - grown, self.high + grown)
        self.pairs = pairs[~np.isin(pairs @ [blocks.count, 1], self.joined)]
        self.one, self.axis = self.pairs[:, 0].copy(), np.zeros((len(self.pairs), 3))
        self.sum = self.pairs.sum(axis=1)
        if len(self.pairs) and len(self.convex) == 0:
            self.convex = are_convex(blocks, FLAT * extent(blocks))
        gap = self._face_each_other(blocks, np.arange(len(self.pairs)))
        self.codes = self.pairs @ [blocks.count, 1]
        self.smaller, self.larger = self.size[self.pairs].min(axis=1), self.radius[self.pairs].max(axis=1)
        self.least, self.touching = DEEP * self.smaller, gap <= TOUCHING * self.smaller

    def _face_each_other(self, blocks: Blocks, which: np.ndarray) -> np.ndarray:
        """Find the face of either block that parts some candidates best; returns the gaps that they leave (m)."""
        gap, face = widest_gaps(blocks, self.pairs[which])
        self.one[which], self.axis[which] = self.owner[face], self.normal[face]
        return gap

    def _not_parted(self, place: np.ndarray, gradient: np.ndarray, depth: np.ndarray) -> np.ndarray:
        """The candidates that neither the axis between them, turned with its block, nor their boxes still part."""
        return np.flatnonzero(overlap_on_all(place, gradient, self.one, self.sum, self.axis, depth))

    def _look_closely(self, step: int, near: np.ndarray, depth: np.ndarray, gradient: np.ndarray) -> None:
        """Stop if these candidates overlap, or make it a doubt; if not, find the axis that parts them now."""
        moved, convex = self.corners.displaced(), self.convex[self.pairs[near]].all(axis=1)
        gap = self._face_each_other(moved, near)
        for k in np.flatnonzero(~convex | (gap < -depth)).tolist():
            n = int(near[k])
            one, two = self.pairs[n].tolist()
            deep, axis = overlap(moved, one, two, float(depth[k]), bool(convex[k]))
            if deep:
                self._meet(step, n, moved)
            elif axis is not None:
                self.one[n], self.axis[n] = one, np.linalg.solve(np.eye(3) - gradient[one].T, axis)

    def _meet(self, step: int, n: int, moved: Blocks) -> None:
        """Stop, or make it a doubt where the two blocks touched from the beginning."""
        one, two = self.pairs[n].tolist()
        low, high = (values[[one, two]] for values in bounds(moved))
        place = ", ".join(f"{x:.4g}" for x in (low.max(axis=0) + high.min(axis=0)) / 2)
        words = f"{self._name(one)} and {self._name(two)} meet around ({place}) m, where they have no joint"
        self.last = f"{words}, from step {step} on"
        if self.codes[n] in self.met or not self.touching[n]:
            raise MovedTooFar(
                f"step {step}: {words}; contacts are found once, before the run, so nothing would hold them apart: "
                "end the drive before, or let them touch from the beginning"
            )
        self.met, self.words = np.append(self.met, self.codes[n]), self.words or self.last

    def _name(self, block: int) -> str:
        """Name of a block in a scene: the smallest of its sets that holds it, with its number where that holds more."""
        holding = {name: len(members) for name, members in self.sets.items() if block in members}
        if not holding:
            return f"block {block} (unit {self.blocks.unit[block]})"
        name = min(holding, key=lambda name: holding[name])
        return f"'{name}'" if holding[name] == 1 else f"block {block} of '{name}'"


def joined_pairs(model: Model) -> np.ndarray:
    """(P,) the pairs of blocks that have a joint: the number of one, times all blocks, plus the number of the other."""
    return np.unique(model.joints.block_a * model.blocks.count + model.joints.block_b)


def are_all_joined(pairs: np.ndarray, blocks: Blocks) -> bool:
    """Whether every two blocks have a joint, so that none can meet another anew."""
    return 2 * len(pairs) == blocks.count * (blocks.count - 1)


def compile_look(model: Model) -> None:
    """Compile what a look needs, on one block, if the model has blocks that can meet; and what frames need."""
    compile_frame(model)
    if are_all_joined(joined_pairs(model), model.blocks):
        return
    place, gradient, one = np.zeros((1, 1, 3)), np.zeros((1, 3, 3)), np.zeros(1, dtype=np.int64)
    move(place, place, np.zeros((1, 3)), gradient, place, np.zeros(1))
    write_depths(np.zeros(1), 0.0, np.zeros(1), np.zeros(1), np.zeros(1))
    overlap_on_all(place, gradient, one, one, np.array([[0.0, 0.0, 1.0]]), np.zeros(1))


@compiled
def overlap_along(place, gradient, a, b, axis):
    """m, how far block b overlaps block a along an axis from a to b; below 0: they are as far apart.

    place     (B, K, 3) m, corners of all blocks
    gradient  (B, 3, 3) of the displacement of each block: the axis has turned with block a
    axis      (3,) as it was in the beginning: the normal of a face of block a, or across two edges
    """
    n, g = axis, gradient[a]
    x = n[0] - g[0, 0] * n[0] - g[1, 0] * n[1] - g[2, 0] * n[2]
    y = n[1] - g[0, 1] * n[0] - g[1, 1] * n[1] - g[2, 1] * n[2]
    z = n[2] - g[0, 2] * n[0] - g[1, 2] * n[1] - g[2, 2] * n[2]
    own, other = -np.inf, np.inf
    for k in range(place.shape[1]):
        own = max(own, x * place[a, k, 0] + y * place[a, k, 1] + z * place[a, k, 2])
        other = min(other, x * place[b, k, 0] + y * place[b, k, 1] + z * place[b, k, 2])
    return (own - other) / np.sqrt(x * x + y * y + z * z)


@compiled
def write_depths(opening, turning, least, larger, depth):
    """Write the overlap (N,) m that needs no meeting: a least one (N,), what the deepest closure of all contacts with
    these openings (C,) m squeezes corners by, and a share of the larger block (N,) m, as it turned."""
    closure = 0.0
    for c in range(len(opening)):
        closure = min(closure, opening[c])
    for p in range(len(depth)):
        depth[p] = (least[p] - CLOSURES * closure) + turning * larger[p]


@compiled
def overlap_on_all(place, gradient, one, both, axis, depth):
    """(N,) whether two blocks overlap by more than a depth (N,) m along an axis (N, 3) from one to the other, and along
    x, y and z; both (N,): the sum of their numbers."""
    overlap = np.zeros(len(one), dtype=np.bool_)
    for p in range(len(one)):
        a, b = one[p], both[p] - one[p]
        overlap[p] = overlap_along(place, gradient, a, b, axis[p]) > depth[p]
        for i in range(3 if overlap[p] else 0):
            of_a, of_b = place[a, :, i], place[b, :, i]
            common = min(of_a.max(), of_b.max()) - max(of_a.min(), of_b.min())
            overlap[p] = overlap[p] and common > depth[p]
    return overlap
