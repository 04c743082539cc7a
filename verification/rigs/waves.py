"""A plane wave in a bar of tets that a joint cuts in two: any velocity history at one end, displacements afterwards."""

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from geometry.block_file import save_blocks
from masonry import laboratory, scene, timeloop
from masonry.assembly import assemble
from masonry.loads import Program
from masonry.results import Result
from verification.rigs.structured import row_of_boxes

MODULUS, DENSITY = 10e9, 2500.0
"""Poisson's ratio is 0. A wave along x moves all points along x, or (a shear wave) all along z."""
WAVELENGTH = 1.0

ANY_JOINT = 'normal_stiffness = "1 Pa/m"\nshear_stiffness = "1 Pa/m"'
Floats = np.ndarray


@dataclass(frozen=True)
class Bar:
    """Lengths in wavelengths of 1 m; a bar without joint is one block.

    shear     whether points move along z (modulus E/2), not along x
    joint     the table [contact.unit_unit]; "" for a bar without one
    before, after  where the joint is, and how long the bar goes on
    """

    shear: bool
    joint: str
    before: float = 4.0
    after: float = 4.25

    @property
    def speed(self) -> float:
        """Of the wave, m/s."""
        return float(np.sqrt(self.modulus / DENSITY))

    @property
    def modulus(self) -> float:
        """That the wave feels, Pa."""
        return MODULUS / 2 if self.shear else MODULUS

    @property
    def impedance(self) -> float:
        """Z = rho c, Pa s/m."""
        return DENSITY * self.speed

    def text(self) -> str:
        """The scene; its drive is replaced by a velocity history."""
        along, across = ("z", '["x", "y"]') if self.shear else ("x", '["y", "z"]')
        return f"""
law = "elastic"
kinematics = "tets"
[specimen]
kind = "file"
path = "made.blocks.h5"
[material.units]
density = "{DENSITY} kg/m^3"
young_modulus = "{MODULUS} Pa"
poisson_ratio = 0
[contact.unit_unit]
{self.joint or ANY_JOINT}
[[support]]
on = "all"
fix = {across}
[[support]]
on = "box {1 if self.joint else 0}.x+"
fix = "{along}"
[drive]
on = "box 0.x-"
direction = "{along}"
displacement = "1 mm"
steps = 100
[solver]
masses = "real"
damping = 0
step_fraction = 0.9
rows = 100
rotation_limit = 0.5
"""

    def run(self, per_wavelength: int, moved: Callable[[Floats], Floats], time: float) -> "Wave":
        """The wave at a time (s) after its end began to move as `moved` says: (n,) s -> (n,) m."""
        lengths = [self.before, self.after] if self.joint else [self.before + self.after]
        cuts = np.concatenate([[0.0], np.cumsum(lengths)]) * WAVELENGTH
        h = WAVELENGTH / per_wavelength
        cells = [(round(part * per_wavelength), 1, 1) for part in lengths]
        specimen, mesh = row_of_boxes(list(cuts), cells, h, h, h * h)
        with tempfile.TemporaryDirectory() as folder:
            save_blocks(Path(folder) / "made.blocks.h5", specimen, mesh)
            (Path(folder) / "bar.toml").write_text(self.text(), encoding="utf-8")
            assembly = assemble(scene.load(Path(folder) / "bar.toml"))
        dt = assembly.model.dt
        steps = round(time / dt)
        place = moved(dt * np.arange(-1, steps + 1))
        speed = np.diff(place) / dt  # the first step starts at rest: the end is one step late
        plan = Program(np.zeros(steps + 1), speed, 0, 0)
        result = laboratory.result_of(assembly, timeloop.run(assembly.model, plan, assembly.recording))
        nodes = result.history.frames[-1].nodes[:, 2 if self.shear else 0]
        sections = nodes.reshape(-1, 4)
        along = mesh.nodes[:, 0].reshape(-1, 4)[:, 0]
        weight = np.array([2.0, 1.0, 1.0, 2.0]) / 6  # thirds of the two triangles of a section
        return Wave(along, sections @ weight, (steps - 1) * dt, h * h, result)


@dataclass(frozen=True)
class Wave:
    """Displacement u (n,) m of the sections at x (n,) m, where the joint's place is there twice; time (s) of the end,
    area (m2) of the bar."""

    x: Floats
    u: Floats
    time: float
    area: float
    result: Result
