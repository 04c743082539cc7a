"""Pairs of bodies put together for tests of detection, and what `touch` says of them, as plain arrays."""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from geometry.blocks import Blocks
from geometry.cells.domain import box_domain
from geometry.cells.power import tessellate
from geometry.cells.power_blocks import to_blocks
from geometry.polyhedra.construct import from_boxes, from_faces
from geometry.polyhedra.measures import centroids
from masonry.detection import narrow
from masonry.detection.overlap import most_points, scratch_of
from masonry.detection.pieces import pieces_of
from masonry.detection.placing import turned_of, update_pieces
from masonry.jit.compiler import jit

FAR = 1e300
touch = jit(narrow.touch.py_func)
"""As Python may call it."""


class Touching(NamedTuple):
    kind: int
    separation: float
    blend: float
    size: float
    axis: np.ndarray
    point: np.ndarray
    gap: np.ndarray
    area: np.ndarray
    feature: np.ndarray
    witness: np.ndarray


class Bodies:
    """Blocks as pieces, each with a place and a frame."""

    def __init__(self, blocks: Blocks) -> None:
        self.pieces = pieces_of(blocks)
        self.turned = turned_of(self.pieces)
        self.position = centroids(blocks)
        self.frame = np.tile(np.eye(3), (blocks.count, 1, 1))
        self.scratch = scratch_of(self.pieces)

    def put(self, body: int, position=None, frame=None) -> "Bodies":
        if position is not None:
            self.position[body] = position
        if frame is not None:
            self.frame[body] = frame
        update_pieces(self.pieces, self.frame, self.turned)
        return self

    def move(self, turn: np.ndarray, shift: np.ndarray) -> "Bodies":
        """All bodies turned about the origin and shifted."""
        self.position[:] = self.position @ turn.T + shift
        self.frame[:] = turn @ self.frame
        update_pieces(self.pieces, self.frame, self.turned)
        return self

    def touch(self, p=0, q=1, skin=FAR, reach=FAR, least=1e-4, witness=None) -> Touching:
        k = most_points(self.pieces)
        axis, witness = np.zeros(3), np.array([-1, -1, -1]) if witness is None else witness.copy()
        point, gap, area, feature = np.zeros((k, 3)), np.zeros(k), np.zeros(k), np.zeros(k, dtype=np.int64)
        kind, count, separation, blend, size = touch(
            self.pieces, self.turned, self.position, p, q, skin, reach, least, False, axis, witness, self.scratch,
            point, gap, area, feature,
        )  # fmt: skip
        columns = point[:count], gap[:count], area[:count], feature[:count]
        return Touching(kind, separation, blend, size, axis, *columns, witness)

    def corners(self, p: int) -> np.ndarray:
        start = self.pieces.vertex_start
        return self.turned.vertex[start[p] : start[p + 1]] + self.position[self.pieces.body[p]]


def boxes(*low_high) -> Bodies:
    low, high = (np.array([pair[k] for pair in low_high], dtype=float) for k in (0, 1))
    return Bodies(box_blocks(low, high))


def box_blocks(low, high) -> Blocks:
    return from_boxes(low, high, np.arange(len(low)), np.zeros(len(low), dtype=int), ("units",))


def cells(count: int, seed: int) -> Blocks:
    """Laguerre cells of a unit cube."""
    rng = np.random.default_rng(seed)
    sites, domain = rng.random((count, 3)), box_domain(np.zeros(3), np.ones(3))
    return to_blocks(tessellate(sites, 0.01 * rng.random(count), domain), np.arange(count))


def subset(blocks: Blocks, which) -> Blocks:
    """Some of the blocks."""
    faces = [[blocks.face(f) for f in blocks.faces_of(b)] for b in which]
    return from_faces(faces, np.arange(len(which)), np.zeros(len(which), dtype=int), blocks.groups)


def turn(*vector: float) -> np.ndarray:
    return Rotation.from_rotvec(vector).as_matrix()


def random_turn(rng: np.random.Generator) -> np.ndarray:
    return Rotation.random(random_state=rng).as_matrix()
