"""Many walls of one scene whose properties scatter: their peaks, their curves, and how often each joint cracks."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from masonry.laboratory.result import Result
from masonry.laboratory.summary.cracks import BROKEN
from masonry.pictures.camera import front_view
from masonry.pictures.crack_lines import CrackLines, crack_lines
from verification.paper.experiment import Done

POINTS = 300
"""Places along a curve at which walls are compared."""
PATHS = ("stepped", "mixed", "straight")


@dataclass(frozen=True)
class Wall:
    """Data kept of a run.

    peak         Pa
    stress       (POINTS,) Pa, at equal distances of the drive
    broken       (n,) which of its crack lines are broken at the end
    places       joints (pairs of units) broken over half their area at least, and units (twice the same) broken at all
    path         how its crack goes: "stepped" through joints alone, "straight" through units and head joints but no bed
                 joint, or "mixed" through units and bed joints
    by_opening   share of the fracture energy that mode I took
    """

    peak: float
    stress: np.ndarray
    broken: np.ndarray
    places: frozenset[tuple[int, int]]
    path: str
    by_opening: float


@dataclass(frozen=True)
class Ensemble:
    """Walls of one scene (or one alone), and what they have in common.

    drive   (POINTS,) m
    lines   where the joints and the faces within units are seen edge-on
    joint   (n,) whether a line lies between two units
    """

    walls: list[Wall]
    drive: np.ndarray
    lines: CrackLines
    joint: np.ndarray

    @property
    def peaks(self) -> np.ndarray:
        """(walls,) Pa."""
        return np.array([wall.peak for wall in self.walls])

    @property
    def variation(self) -> float:
        """Coefficient of variation of the peak."""
        return float(self.peaks.std(ddof=1) / self.peaks.mean())

    @property
    def frequency(self) -> np.ndarray:
        """(n,) share of the walls in which a line is broken at the end."""
        return np.mean([wall.broken for wall in self.walls], axis=0)

    @property
    def patterns(self) -> int:
        """How many different sets of places are broken."""
        return len({wall.places for wall in self.walls})

    @property
    def paths(self) -> dict[str, int]:
        """How many walls crack along each of the PATHS."""
        return {path: sum(wall.path == path for wall in self.walls) for path in PATHS}

    def band(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(POINTS,) Pa each: the quantiles 5 % and 95 % of the stress at each place of the drive, and the median."""
        stress = np.array([wall.stress for wall in self.walls])
        below, above, middle = np.quantile(stress, [0.05, 0.95, 0.5], axis=0)
        return below, above, middle


def ensemble(done: Done, labels: Sequence[str]) -> Ensemble:
    """The runs of these labels, which have one specimen; each is let go once it is read. Raises Missing."""
    first = done[labels[0]]
    view = front_view(first.specimen.blocks.points)
    lines = crack_lines(first.joints, first.history.frames[-1], view)
    unit = first.specimen.blocks.unit
    joint = unit[first.joints.block_a[lines.contact]] != unit[first.joints.block_b[lines.contact]]
    drive = np.linspace(0.0, float(first.history.rows["displacement"][-1]), POINTS)
    walls = []
    for label in labels:
        walls.append(wall(done[label], drive))
        done.loaded.pop(label)
    return Ensemble(walls, drive, lines, joint)


def wall(result: Result, drive: np.ndarray) -> Wall:
    """Data kept of a result; stress at places of the drive (m)."""
    rows, frame, joints = result.history.rows, result.history.frames[-1], result.joints
    lines = crack_lines(joints, frame, front_view(result.specimen.blocks.points))
    unit = result.specimen.blocks.unit
    pairs = np.sort(np.column_stack([unit[joints.block_a], unit[joints.block_b]]), axis=1)
    broken = joints.area * (frame.damage >= BROKEN)
    names, index = np.unique(pairs, axis=0, return_inverse=True)
    fraction = np.bincount(index.ravel(), broken) / np.bincount(index.ravel(), joints.area)
    within = names[:, 0] == names[:, 1]
    gone = np.where(within, fraction > 0.0, fraction >= 0.5)
    energy = result.summary["energy_j"]
    fracture = energy["fracture_mode_1"] + energy["fracture_mode_2"]
    inside = pairs[:, 0] == pairs[:, 1]
    units, beds = broken[inside].any(), broken[~inside & (np.abs(joints.normal[:, 2]) > 0.5)].any()
    return Wall(
        peak=float(result.summary["peak_stress_pa"]),
        stress=np.interp(drive, rows["displacement"], rows["stress"]),
        broken=lines.damage >= BROKEN,
        places=frozenset((int(a), int(b)) for a, b in names[gone]),
        path="stepped" if not units else "mixed" if beds else "straight",
        by_opening=float(energy["fracture_mode_1"] / fracture),
    )
