"""Result of a modal analysis as data: frequencies, shapes, effective masses, and the damping that they require."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Specimen
from geometry.polyhedra.construct import with_own_points
from masonry.model.kinds import KIND
from masonry.model.layout import KINDS, Layout
from masonry.scene import Scene


@dataclass(repr=False)
class ModesData:
    """The slowest modes of a scene, the slowest first.

    frequencies     (m,) Hz
    effective_mass  (m, 3) kg that takes part in each when the ground moves along x, y, z; over all modes they add up
                    to `mass`
    mass            (3,) kg that can move along x, y, z: what no support holds
    shapes          of each mode, by kind, (rows, dofs) as in Layout, m, and turns or strains; a modal mass of 1 kg
    corners         (m, P, 3) displacements of `blocks.points`; the largest of each mode is 1
    blocks          the blocks, each with points of its own
    loose           how many motions nothing resists; loose_blocks: which blocks take part in one
    closed          (C,) contacts that were taken as closed; of the joints as the scene has them
    covered         (F,) faces of `blocks` that lie in joints as a whole
    ratio, between  damping ratio, and the two modes (1, 2, ...) at which Rayleigh damping has it
    assumed         what the joints are taken as, in words
    """

    scene: Scene
    specimen: Specimen
    layout: Layout
    assumed: str
    frequencies: np.ndarray
    effective_mass: np.ndarray
    mass: np.ndarray
    shapes: list[dict[str, np.ndarray]]
    blocks: Blocks
    corners: np.ndarray
    closed: np.ndarray
    covered: np.ndarray
    ratio: float
    between: tuple[int, int]
    dofs: int
    loose: int = 0
    loose_blocks: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    remarks: list[str] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def title(self) -> str:
        """The scene's title, or its name where it has none."""
        return self.scene.title or self.scene.name

    @property
    def share(self) -> np.ndarray:
        """(m, 3) of the mass that can move, along x, y, z; 0 where none can."""
        return self.effective_mass / np.where(self.mass > 0.0, self.mass, np.inf)

    @property
    def rayleigh(self) -> tuple[float, float] | None:
        """a0 (1/s) and a1 (s) of a damping a0 M + a1 K that has the ratio at both modes; None without any mode."""
        if not len(self.frequencies):
            return None
        first, second = (2.0 * np.pi * float(self.frequencies[number - 1]) for number in self.between)
        return rayleigh_numbers(self.ratio, first, second)

    def as_data(self) -> dict[str, Any]:
        """All of it as plain values for JSON, in SI."""
        damping = self.rayleigh
        return {
            "scene": self.scene.name,
            "assumed": self.assumed,
            "blocks": self.blocks.count,
            "freedoms": self.dofs,
            "contacts": len(self.closed),
            "closed_contacts": int(self.closed.sum()),
            "mass_kg": self.mass.tolist(),
            "loose_motions": self.loose,
            "loose_blocks": self.loose_blocks.tolist(),
            "modes": [
                {
                    "frequency_hz": float(frequency),
                    "period_s": 1.0 / float(frequency),
                    "effective_mass_kg": effective.tolist(),
                    "share_of_mass": share.tolist(),
                    "displacement": move.tolist(),
                }
                for frequency, effective, share, move in zip(
                    self.frequencies, self.effective_mass, self.share, self.movements(), strict=True
                )
            ],
            "displacement_is": "of the middle of each block along x, y, z; the farthest corner of a mode moves by 1",
            "rayleigh": None
            if damping is None
            else {
                "ratio": self.ratio,
                "between_modes": list(self.between),
                "a0_per_s": damping[0],
                "a1_s": damping[1],
            },
            "seconds": self.seconds,
            "remarks": self.remarks,
        }

    def movements(self) -> np.ndarray:
        """(m, B, 3) mean displacement of the corners of each block."""
        block, count = block_of_points(self.blocks), self.blocks.count
        number = np.maximum(np.bincount(block, minlength=count), 1)
        sums = [[np.bincount(block, moved[:, k], count) / number for k in range(3)] for moved in self.corners]
        return np.array(sums).reshape(-1, 3, count).transpose(0, 2, 1)


def rayleigh_numbers(ratio: float, first: float, second: float) -> tuple[float, float]:
    """a0 (1/s) and a1 (s), so that a0/(2 w) + a1 w/2 is the ratio at both w (rad/s)."""
    return 2.0 * ratio * first * second / (first + second), 2.0 * ratio / (first + second)


def moved_corners(layout: Layout, blocks: Blocks, shape: dict[str, np.ndarray]) -> np.ndarray:
    """(P, 3) m, how corners of blocks move; shape: rows of dofs by kind. Those of tets as their nearest node."""
    block = block_of_points(blocks)
    arm, axes, row = blocks.points - layout.centroid[block], layout.axes[block], layout.local[block]
    moved = np.zeros_like(arm)
    for name, values in shape.items():
        p, kind = np.flatnonzero(layout.kind[block] == KINDS.index(name)), KIND[name]
        if not len(p):
            continue
        if kind.nodal:
            moved[p] = values[_nearest_nodes(layout, blocks.points[p], block[p])]
            continue
        one, dofs = np.ones((len(p), 3)), values[row[p]]
        columns = kind.columns(np.einsum("pji,pj->pi", axes[p], arm[p]), axes[p], one) * kind.lengths(one)[:, None]
        moved[p] = dofs[:, :3] + np.einsum("pin,pn->pi", columns, dofs[:, 3:])
    return moved


def block_of_points(blocks: Blocks) -> np.ndarray:
    """(P,) the block that each point is a corner of, where no two share any."""
    block = np.zeros(len(blocks.points), dtype=np.int64)
    block[blocks.face_points] = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    return block


def own_points(specimen: Specimen) -> Blocks:
    """The blocks of a specimen, each with points of its own, as modes move them apart."""
    return with_own_points(specimen.blocks)


def _nearest_nodes(layout: Layout, points: np.ndarray, block: np.ndarray) -> np.ndarray:
    """(p,) the node nearest to each point (p, 3) among those of its block (p,)."""
    from scipy.spatial import cKDTree

    mesh = layout.mesh
    assert mesh is not None
    far = 10.0 * float(np.ptp(mesh.nodes, axis=0).max())  # a fourth axis on which other blocks are out of reach
    tree = cKDTree(
        np.column_stack([mesh.nodes, far * np.repeat(np.arange(len(layout.kind)), np.diff(mesh.node_start))])
    )
    return np.asarray(tree.query(np.column_stack([points, far * block]))[1])
