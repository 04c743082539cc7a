"""How joints crush: their contacts, and the faces that meet as patches in their place; what it took, and what goes from
one to the other. Joints that do not crush answer to the same questions, with nothing."""

from functools import cached_property
from typing import Any

import numpy as np

from masonry.detection.narrow import FACE
from masonry.elements.element import Element
from masonry.elements.joints.cells_of_joints import cells_of_joints
from masonry.model.element_plan import ElementPlan
from masonry.model.large.meeting import Large
from masonry.model.model import Model
from masonry.patches.arrays import CRUSHED, NORMAL_GAINED, PLACE
from masonry.patches.crushed_points import CLOSING, HARDENING, KEPT
from masonry.patches.press import stored
from masonry.rows.columns import CRUSHING
from masonry.simd import FOUR

NOWHERE = 0.0, (0, 0)


class JointCrushing(Element):
    """Joints of a model that do not crush."""

    name = "crushed"

    def __init__(self, model: Model) -> None:
        super().__init__(ElementPlan())
        self.model = model

    def closing(self) -> np.ndarray | None:
        """(C,) m, plastic closing of the joints now, by contacts and patches; None where crushing is not modelled."""
        return None

    def of_contacts(self) -> Any:
        """Plastic closing (C,) m of the contacts; 0.0 for all where they do not crush."""
        return 0.0

    def closed(self, opening: np.ndarray) -> np.ndarray:
        """(C,) m by which the springs of contacts close that open by so much: what they crushed is a loss of the joint,
        and no overlap."""
        return -opening

    def in_contacts(self, extent: np.ndarray) -> tuple[float, int]:
        """The largest plastic closing of a contact over an extent (C,) m, and which contact that is."""
        return 0.0, 0

    def in_patches(self, width: np.ndarray) -> tuple[float, tuple[int, int]]:
        """The largest plastic closing of a patch, over the widths (B,) m of the thinner of its two blocks, and which
        they are."""
        return NOWHERE

    def densities(self, dissipated: np.ndarray) -> np.ndarray:
        """A copy of what contacts dissipated (C, 3) J/m2, and in a fourth column what crushing took of them."""
        return dissipated.copy(order="K")

    def part(self, parted: np.ndarray, going: np.ndarray) -> None:
        """Take the plastic closing of contacts that are going from how far their sides are parted, (C, 3) m."""

    def to_hand_over(self, going: np.ndarray) -> np.ndarray:
        """(n, 2) m, plastic closing and hardening of contacts that are going; (n, 0) where they do not crush."""
        return np.zeros((len(going), 0))

    def hand_over(self, p: int, place: np.ndarray, closings: np.ndarray) -> None:
        """Crush the points of a new patch of two faces as the contacts next to them were, at places (n, 3) m."""


class CrushedContacts(JointCrushing):
    """Contacts that crush."""

    @property
    def crushed(self) -> np.ndarray:
        """(C, 3) m, m, J/m2."""
        return self.model.state.crushed

    def closing(self) -> np.ndarray | None:
        return np.array(self.crushed[:, 0])

    def of_contacts(self) -> np.ndarray:
        return self.crushed[:, 0]

    def closed(self, opening: np.ndarray) -> np.ndarray:
        return np.asarray(-opening - self.crushed[:, 0])

    def in_contacts(self, extent: np.ndarray) -> tuple[float, int]:
        share = self.crushed[:, 0] / extent
        worst = int(np.argmax(share))
        return float(share[worst]), worst

    def densities(self, dissipated: np.ndarray) -> np.ndarray:
        return np.column_stack([dissipated, self.crushed[:, 2]])

    def part(self, parted: np.ndarray, going: np.ndarray) -> None:
        parted[going] -= self.crushed[going, :1] * self.model.contacts.normal[going]

    def to_hand_over(self, going: np.ndarray) -> np.ndarray:
        return np.array(self.crushed[going, :2])

    def taken(self) -> dict[str, float]:
        return {CRUSHING: float(self.model.joints.area @ self.crushed[:, 2])}


class JointsOfCrushedFaces(JointCrushing):
    """Faces of blocks that crush where they meet as patches, in large displacement."""

    def __init__(self, model: Model, large: Large) -> None:
        super().__init__(model)
        self.parts = large
        block = np.sort(np.column_stack([model.joints.block_a, model.joints.block_b]), axis=1)
        pair, pair_of = np.unique(block, axis=0, return_inverse=True)
        self.pair_of = np.reshape(pair_of, -1)
        self.number = {(int(a), int(b)): k for k, (a, b) in enumerate(pair)}

    @cached_property
    def cells(self) -> np.ndarray:
        """(2, C) as of cells_of_joints."""
        return cells_of_joints(self.model.joints, self.parts.near)

    def closing(self) -> np.ndarray | None:
        """Of both faces at a place, or of the bond while it is there."""
        model, faces = self.model, self.parts.near.crushed
        patches = np.where(self.cells >= 0, faces.closing[self.cells], 0.0).sum(axis=0)
        self._add_growth(patches, np.flatnonzero(~model.alive))
        return np.where(model.alive, self.of_contacts(), patches)

    def _add_growth(self, closing: np.ndarray, gone: np.ndarray) -> None:
        """Add to the closing (C,) of joints that are gone what the points there have not told their faces yet."""
        near, crushed, pair_of = self.parts.near, self._of_points, self.pair_of[gone]
        pairs, points = near.pairs, near.points
        for p in np.flatnonzero((pairs.slot[: pairs.number[0]] >= 0) & (pairs.witness[: pairs.number[0], 0] == FACE)):
            s, blocks = pairs.slot[p], np.sort(near.pieces.block[pairs.body[p]])
            k = np.arange(points.number[s])
            grown = crushed[s, k // FOUR, CLOSING, k % FOUR] - crushed[s, k // FOUR, KEPT, k % FOUR]
            beside = gone[pair_of == self.number.get((int(blocks[0]), int(blocks[1])), -1)]
            if not grown.any() or len(beside) == 0:
                continue
            apart = self.model.joints.point[beside][:, None] - self._places(p, k)
            closing[beside] += grown[np.argmin(np.einsum("ckj,ckj->ck", apart, apart), axis=1)]

    def in_patches(self, width: np.ndarray) -> tuple[float, tuple[int, int]]:
        near, crushed = self.parts.near, self._of_points
        pairs, points = near.pairs, near.points
        p = np.flatnonzero(pairs.slot[: pairs.number[0]] >= 0)
        blocks, s = near.pieces.block[pairs.body[p]], pairs.slot[p]
        closing = crushed[:, :, CLOSING].reshape(len(crushed), -1)[s]
        share = np.where(np.arange(closing.shape[1]) < points.number[s][:, None], closing, 0.0).max(axis=1, initial=0.0)
        share /= width[blocks].min(axis=1)
        if not share.any():
            return NOWHERE
        worst = int(share.argmax())
        return float(share[worst]), (int(blocks[worst, 0]), int(blocks[worst, 1]))

    def hand_over(self, p: int, place: np.ndarray, closings: np.ndarray) -> None:
        """Faces are told at the next look. What the points hold is booked as if they had been so before."""
        near, crushed = self.parts.near, self._of_points
        if near.pairs.witness[p, 0] != FACE or closings.shape[1] == 0:
            return
        pressed, s = self._pressed(p), near.pairs.slot[p]
        k = np.arange(near.points.number[s])
        next_to_it = np.argmin(np.sum((place - self._places(p, k)[:, None]) ** 2, axis=2), axis=1)
        for row, column in zip((CLOSING, HARDENING), closings.T, strict=True):
            crushed[s, k // FOUR, row, k % FOUR] += column[next_to_it]
        near.account[NORMAL_GAINED] += self._pressed(p) - pressed

    def taken(self) -> dict[str, float]:
        return {CRUSHING: super().taken().get(CRUSHING, 0.0) + float(self.parts.near.account[CRUSHED])}

    def written(self) -> dict[str, np.ndarray]:
        return {name: getattr(self.parts.near.crushed, name) for name in ("closing", "hardening", "begun")}

    @property
    def _of_points(self) -> np.ndarray:
        return self.parts.near.points.crushed  # type: ignore[return-value]

    def _places(self, p: Any, k: np.ndarray) -> np.ndarray:
        """(n, 3) m, of the points k of a patch, as its body was made."""
        near, s = self.parts.near, self.parts.near.pairs.slot[p]
        body = near.pairs.body[p, near.pairs.points_of[p]]
        return np.asarray(near.motion.centre[body] + near.points.quads[k // FOUR, s, PLACE : PLACE + 3, k % FOUR])

    def _pressed(self, p: int) -> float:
        """J that a patch holds by pressure."""
        near = self.parts.near
        return float(stored(near.pairs, near.points, near.rules, near.motion, p)[0])


class CrushedJoints(JointsOfCrushedFaces, CrushedContacts):
    """Both: faces take over from contacts."""


def crushing_of_contacts(model: Model) -> JointCrushing:
    """Answers for the contacts of a model, as far as they crush."""
    return CrushedContacts(model) if model.crushes else JointCrushing(model)


def crushing_of_joints(model: Model, large: Large) -> JointCrushing:
    """Answers for the joints of a model of large displacement, as far as they crush."""
    if large.near.crushed is None:
        return crushing_of_contacts(model)
    return CrushedJoints(model, large) if model.crushes else JointsOfCrushedFaces(model, large)
