"""What a run remembers: rows of the curve and of the energy ledger, and a few frames of the whole specimen."""

from dataclasses import dataclass, field

import numpy as np

UNITS = {
    "step": "1",
    "time": "s",
    "displacement": "m",
    "stress": "Pa",
    "support_stress": "Pa",
    "force": "N",
    "external_work": "J",
    "elastic_blocks": "J",
    "elastic_contacts": "J",
    "fracture_mode_1": "J",
    "fracture_mode_2": "J",
    "friction": "J",
    "damping": "J",
    "kinetic": "J",
    "contact_work": "J",
    "imbalance": "J",
}
"""The columns of a history, with the unit of each; the columns of gauges, in m, come besides. `stress` is taken at the
drive, `support_stress` at the support, `force` is that of the drive;
`contact_work` is the trapezoid work that the contacts took up, `imbalance` what is left of the energy balance."""


LARGE_UNITS = {"rotor": "J", "dashpot": "J", "redetection": "J", "area": "J"}
"""Columns of large displacement besides: what free rotations, and blocks that deform, lost by the step's length; what
dashpots dissipated; what shear lost as contacts were detected anew; what pressed areas that went or shrank held, less
those that came or grew."""


TILT = "tilt_of_gravity"
"""The column (rad) of a run whose gravity is turned."""
FACTOR = "load_factor"
"""The column (1) of a run whose load grows until it falls."""
OFF_BALANCE = "out_of_balance"
"""The column (1) of one that leads a gauge on behind the collapse: by how much the factor exceeds equilibrium, on
average since the row before, over the collapse factor; 0 at the rests before."""


def unit_of(column: str) -> str:
    """Of a column of a history; all that are not in UNITS are gauges, but for the tilt, the load factor and how far it
    is from equilibrium."""
    return {TILT: "rad", FACTOR: "1", OFF_BALANCE: "1"}.get(column) or UNITS.get(column) or LARGE_UNITS.get(column, "m")


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

    @property
    def damage(self) -> np.ndarray:
        """(C,) combined damage."""
        return 1.0 - (1.0 - self.damage_tension) * (1.0 - self.damage_shear)


@dataclass
class History:
    """Rows (one array per key of UNITS and per gauge) and frames of a run, oldest first."""

    rows: dict[str, np.ndarray] = field(default_factory=dict)
    frames: list[Frame] = field(default_factory=list)


LEAST_STORED = 1e-6
"""Share of the external work that counts as stored at least, where kinetic energy is held against what is stored."""

LONE = 10.0
"""Times by which the force on one block may exceed the share that is asked of the sum over all, and by its square the
energy: where all swing together some swing more than the mean; what falls alone exceeds that within some looks."""


def still_moving(terms: dict[str, float]) -> float:
    """Kinetic energy over what the specimen stores, by its ledger (J)."""
    stored = abs(terms["elastic_blocks"] + terms["elastic_contacts"])
    return abs(terms["kinetic"]) / max(stored, LEAST_STORED * abs(terms["external_work"]), 1e-300)
