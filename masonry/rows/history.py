"""History of a run: rows of the curve and of the energy ledger, and a few frames of the whole specimen."""

from dataclasses import dataclass, field

import numpy as np

from masonry.rows.columns import unit_of


@dataclass(frozen=True)
class Frame:
    """The specimen at one moment.

    displacement  m, of the drive
    corners       (P, 3) m, displacement of every corner of the blocks (`Blocks.points`)
    nodes         (N, 3) m, displacement of every tet node; (0, 3) without tets
    opening       (C,) m, normal opening at each contact point
    slip          (C,) m, tangential slip at each contact point
    normal_stress, shear_stress  (C,) Pa, tension positive
    damage_tension, damage_shear (C,) 0 intact .. 1 broken;  damage = 1 - (1 - damage_tension)(1 - damage_shear)
    stress        (B, 6) Pa, mean stress of each block (xx yy zz yz xz xy); of rigid ones from their contacts
    crushing      (C,) m, plastic closing; None where crushing is not modelled
    shear         (C, 3) N, across the normal on side a, as on the undeformed shape; None without patches. It is not
                  written
    """

    step: int
    time: float
    displacement: float
    corners: np.ndarray
    nodes: np.ndarray
    opening: np.ndarray
    slip: np.ndarray
    normal_stress: np.ndarray
    shear_stress: np.ndarray
    damage_tension: np.ndarray
    damage_shear: np.ndarray
    stress: np.ndarray
    crushing: np.ndarray | None = None
    shear: np.ndarray | None = None

    @property
    def parted(self) -> np.ndarray:
        """(C,) m, how far the two faces moved apart or along each other."""
        return np.asarray(np.hypot(np.maximum(self.opening, 0.0), self.slip))

    @property
    def damage(self) -> np.ndarray:
        """(C,) combined damage."""
        return 1.0 - (1.0 - self.damage_tension) * (1.0 - self.damage_shear)


@dataclass(frozen=True)
class Standing:
    """Forces (N) and moments (N m, about the origin of the scene) at one moment: of supports and drive (H, 6), of dead
    loads (L, 6), of damping and of inertia on what is free to move (6,); force (C, 3) N of contacts on their side a.
    """

    step: int
    displacement: float
    reactions: np.ndarray
    loads: np.ndarray
    damping: np.ndarray
    inertia: np.ndarray
    force: np.ndarray


@dataclass
class History:
    """Rows (one array per key of `masonry.rows.columns.UNITS` and per gauge) and frames of a run, oldest first.

    units  of columns that have another one than their name says: gauges of velocities and accelerations
    """

    rows: dict[str, np.ndarray] = field(default_factory=dict)
    frames: list[Frame] = field(default_factory=list)
    units: dict[str, str] = field(default_factory=dict)

    def unit(self, column: str) -> str:
        """Of a column of the rows."""
        return self.units.get(column) or unit_of(column)
