"""Energy that tets store too much in a run, beside all that is stored.

By its share of all elastic energy, that of joints and bars too, the specimen deforms too little under given loads, so
a mesh counts little beside joints that are soft. It is asked of the dead loads when they have settled, and of what a
drive or a growing load changes from there to the peak, so that a pressure does not hide the bending that comes on top.
Without either it is asked of the last frame before anything fell, and of that with most energy in blocks where the
ground shakes.

That share adds up over the blocks, and is at least that of each of them. It hides a block that bends on its own beside
much else. So each block that stores a hundredth of all, with half of what the joints on it store, is asked too.
"""

from typing import NamedTuple

import numpy as np

from geometry.blocks import TetMesh
from masonry.assembly.assemble import Assembly
from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_faces import dry_groups
from masonry.estimates.meshes.stress_error import mesh_error, strain_energy, tet_stresses
from masonry.rows.columns import FACTOR, stored_in
from masonry.rows.history import Frame

COUNTS = 0.01
"""Share of the energy from which on a block is asked alone."""


class Stressed(NamedTuple):
    """Stress (T, 6) of the tets, normal and shear stress (C,) of the contacts, Pa; J that all else stores."""

    tets: np.ndarray
    normal: np.ndarray
    shear: np.ndarray
    rest: float

    def since(self, earlier: "Stressed") -> "Stressed":
        """Change since an earlier state; of the rest the least that it may store by itself."""
        rest = (np.sqrt(self.rest) - np.sqrt(earlier.rest)) ** 2
        return Stressed(self.tets - earlier.tets, self.normal - earlier.normal, self.shear - earlier.shear, float(rest))


class ExcessEnergy(NamedTuple):
    """Of the elastic energy: by how much tets store too much, in all and in the block where it is most; the number of
    that block; the error (T,) J of each tet; when that was, in words."""

    of_all: float
    of_block: float
    block: int
    error: np.ndarray
    when: str


def excess_energies(inspection: Inspection, mesh: TetMesh) -> list[ExcessEnergy]:
    """Of all states of a run that are asked."""
    energy = EnergyOfTets(inspection.assembly, mesh)
    return [energy.excess(state, when) for state, when in _states(inspection, energy)]


def friction_decides(inspection: Inspection) -> bool:
    """Whether the run is made for a load that is borne, that it reached, by dry joints: what these bear is a matter of
    equilibrium, however blocks deform."""
    if not dry_groups(inspection.assembly).all():
        return False
    if FACTOR in inspection.outcome.history.rows:
        return inspection.outcome.loading.falls is not None
    return not inspection.assembly.scene.is_large and inspection.gave_way


class EnergyOfTets:
    """Energy stored in tets and contacts of an assembly, by their stresses."""

    def __init__(self, assembly: Assembly, mesh: TetMesh) -> None:
        self.assembly, self.mesh = assembly, mesh
        tets_of = np.diff(mesh.tet_start)
        self.owner = np.repeat(np.arange(len(tets_of)), tets_of)
        meshed = assembly.model.layout.members["tets"]
        self.lame = np.repeat(assembly.model.bodies.tets.lame, tets_of[meshed], axis=0)
        groups, (self.normal, self.shear) = assembly.model.groups, np.zeros((2, len(assembly.joints.area)))
        for joint, first, end in zip(groups.properties, groups.bounds[:-1], groups.bounds[1:], strict=True):
            self.normal[first:end], self.shear[first:end] = joint.normal_stiffness, joint.shear_stiffness

    def state(self, frame: Frame, rows: dict[str, np.ndarray]) -> Stressed:
        """That of a frame, and what its row stores besides: other blocks, bars, what damage has softened, patches."""
        stress = tet_stresses(self.mesh, frame.nodes, self.lame, self.assembly.scene.is_large)
        row = int(np.searchsorted(rows["step"], frame.step))
        stored = stored_in({name: float(column[row]) for name, column in rows.items()})
        state = Stressed(stress, frame.normal_stress, frame.shear_stress, 0.0)
        known = strain_energy(self.mesh, stress, self.lame).sum() + self.joints(state).sum()
        return state._replace(rest=max(stored - float(known), 0.0))

    def joints(self, state: Stressed) -> np.ndarray:
        """(C,) J that contacts store, as long as they are whole."""
        squares = [
            np.divide(stress**2, stiffness, out=np.zeros_like(stress), where=stiffness > 0.0)
            for stress, stiffness in ((state.normal, self.normal), (state.shear, self.shear))
        ]
        return np.asarray(0.5 * self.assembly.joints.area * (squares[0] + squares[1]))

    def excess(self, state: Stressed, when: str) -> ExcessEnergy:
        """How much too much tets store, of all and of each block with half of the joints on it."""
        joints, count = self.assembly.joints, self.assembly.specimen.blocks.count
        stored, error = mesh_error(self.mesh, state.tets, self.lame)
        in_joints = self.joints(state)
        total = stored.sum() + in_joints.sum() + state.rest
        sides = (np.bincount(block, in_joints, count) for block in (joints.block_a, joints.block_b))
        around = np.bincount(self.owner, stored, count) + 0.5 * sum(sides)
        errors = np.bincount(self.owner, error, count)
        of_block = np.where(around > COUNTS * total, errors / np.maximum(around, 1e-300), 0.0)
        block = int(np.argmax(of_block))
        return ExcessEnergy(float(errors.sum() / max(total, 1e-300)), float(of_block[block]), block, error, when)


def _states(inspection: Inspection, energy: EnergyOfTets) -> list[tuple[Stressed, str]]:
    """The states that are asked, and when they were."""
    frames, assembly, rows = inspection.frames, inspection.assembly, inspection.outcome.history.rows
    peak = inspection.peak
    if assembly.recording.is_shaken:
        blocks = [rows["elastic_blocks"][np.searchsorted(rows["step"], frame.step)] for frame in frames[: peak + 1]]
        return [(energy.state(frames[int(np.argmax(blocks))], rows), "on shaking ground")]
    last = energy.state(frames[peak], rows)
    settled = int(np.argmin([abs(frame.step - assembly.plan.settle) for frame in frames]))
    if settled >= peak or not (assembly.scene.drive is not None or FACTOR in rows):
        return [(last, "at the peak" if assembly.scene.drive is not None else "at the end")]
    first = energy.state(frames[settled], rows)
    return [(first, "under its dead loads"), (last.since(first), "on the way to the peak")]
