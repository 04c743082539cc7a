"""Wallettes of growing size, rigid or filled with tets, and dry walls that fall: what each size costs."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from masonry import scene
from masonry.assembly.assemble import Assembly
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.timeloop import compiled_step
from verification.scene_runs import FOLDER

STEPS = 20_000
"""Steps of the run that set-up and output are compared with."""


@dataclass(frozen=True)
class Wall:
    """A wallette of so many courses and units a course; mesh: "" for rigid blocks, "fan", or a mesh size for gmsh."""

    courses: int
    units: int
    divisions: tuple[int, int] = (4, 4)
    mesh: str = ""

    def scene(self, *more: str) -> scene.Scene:
        """Driven for a few steps, far below any damage."""
        asked = [
            f"specimen.courses={self.courses}",
            f"specimen.units_per_course={self.units}",
            f"specimen.divisions={list(self.divisions)}",
            'drive={on="right plate", direction="x", displacement="1e-4 mm", steps=100}',
        ]
        if self.mesh:
            asked += [
                "kinematics=tets",
                "specimen.mesh=fan" if self.mesh == "fan" else f"specimen.mesh_size={self.mesh}",
            ]
        return scene.load("wallette-mode-1", [*asked, *more])


@dataclass(frozen=True)
class Fall:
    """A dry wall of so many courses and bricks a course that falls 1 mm on a floor."""

    courses: int
    units: int

    def scene(self) -> scene.Scene:
        size = {"specimen.courses": self.courses, "specimen.units_per_course": self.units}
        return scene.load(
            str(FOLDER / "dry-wall-let-go.toml"), size | {"floor.size": [f"{0.22 * self.units + 2} m", "2 m"]}
        )


def items(assembly: Assembly) -> int:
    """Contact points between rigid blocks, or tets, or blocks that fall: what the cost of a step grows with."""
    if assembly.model.large is not None:
        return assembly.specimen.blocks.count
    return len(assembly.model.group) if assembly.mesh is None else len(assembly.mesh.tets)


def stepper(assembly: Assembly) -> tuple[Callable[[], object], int]:
    """A call that takes as many steps on one thread as last a few milliseconds, and their number."""
    model = assembly.model
    compiled_step.compile_for(model, 1)
    steps = max(1, 500_000 // items(assembly))
    chunk, drive_force = Chunk(np.zeros(steps + 1), np.zeros(steps + 1), row=False), np.zeros(steps)
    configuration = configuration_of(model)
    return lambda: configuration.advance(chunk, 1, 0, steps, drive_force), steps


def growth(numbers: Sequence[float], costs: Sequence[float]) -> float:
    """The exponent p of cost = c number^p that fits best; 1 is linear."""
    return float(np.polyfit(np.log(numbers), np.log(costs), 1)[0])
