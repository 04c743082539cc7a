"""Frames made by hand, of assemblies that are not run."""

from typing import Any

import numpy as np

from masonry.assembly.assemble import Assembly, assemble
from masonry.rows.history import Frame
from tests.large.made import dry, slab
from tests.scenes import box

SIDE, HEIGHT = 0.2, 0.1
MIDDLE = 0.3, -0.2, 0.0
"""m, of the underside of the block."""


def frame(assembly: Assembly, step: int = 0, **arrays: np.ndarray) -> Frame:
    """Nothing has moved and nothing is pressed, but for the arrays given."""
    contacts, blocks = len(assembly.joints.area), assembly.specimen.blocks
    by_contact = ("opening", "slip", "normal_stress", "shear_stress", "damage_tension", "damage_shear")
    zeros = {name: np.zeros(contacts) for name in by_contact}
    zeros |= {"corners": np.zeros_like(blocks.points), "nodes": np.zeros((0, 3)), "stress": np.zeros((blocks.count, 6))}
    return Frame(step=step, time=float(step), displacement=0.0, **(zeros | arrays))


def on_a_slab(**more: Any) -> Assembly:
    """A dry block of 0.2 x 0.2 x 0.1 m on a slab."""
    boxes = [
        slab(2.0),
        box("block", (MIDDLE[0] - 0.5 * SIDE, MIDDLE[1] - 0.5 * SIDE, 0.0), (SIDE, SIDE, HEIGHT), "units", 1),
    ]
    return assemble(dry(boxes, turned="points_per_edge = 2", **more))


def moved(assembly: Assembly, block: int, turn: float, slide: tuple[float, float, float]) -> np.ndarray:
    """(P, 3) m: how far corners move where one block turns (rad) about the vertical through its middle and slides."""
    blocks = assembly.specimen.blocks
    corners = np.zeros_like(blocks.points)
    faces = slice(*blocks.block_face_start[[block, block + 1]])
    mine = np.unique(blocks.face_points[blocks.face_start[faces.start] : blocks.face_start[faces.stop]])
    c, s = np.cos(turn), np.sin(turn)
    turned = MIDDLE + (blocks.points[mine] - MIDDLE) @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    corners[mine] = turned + slide - blocks.points[mine]
    return corners
