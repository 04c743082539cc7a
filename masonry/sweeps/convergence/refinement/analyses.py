"""Analyses of a scene that are refined: its run, or the frequencies of its slowest modes, which need no run."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import numpy as np

from geometry.blocks import Blocks, Joints
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory.cost import forecast
from masonry.modal_analysis.oscillator import oscillator_of
from masonry.scene import Scene
from masonry.sweeps.convergence.refinement.answers import Answer, answers_of, with_derived
from masonry.sweeps.convergence.refinement.resolutions import Resolution, jitter, of_space, resolutions_of
from masonry.sweeps.job import Job
from masonry.sweeps.run_store import Row, frequency_key
from masonry.sweeps.work import OK, SHAPES

BESIDE = 6
"""Modes that are computed besides those that are asked for, as refinement changes their order."""
SMALL_SYSTEM, GROWTH = 1000, 1.25
"""Dofs whose modes take no longer than what is built for them, and the power of the dofs by which time grows beyond:
900 and 14,000 of a block of tets took 0.3 and 9.8 s."""
FREQUENCY, MOST = re.compile(r"modes\.(\d{1,3})\.frequency_hz"), 100
"""Names of frequencies, and the highest mode that may be asked for."""


class Size(NamedTuple):
    """Blocks, joints, and contacts at points of joints; and the seconds of processor that an analysis takes, in any
    measure. In large displacement dry joints are patches, and have no such points."""

    seconds: float
    contacts: int
    blocks: Blocks
    joints: Joints
    has_tets: bool


class RefinedAnalysis(Protocol):
    """An analysis of a scene that is refined.

    scatters  whether runs that differ in nothing of meaning differ
    is_timed  whether a size has seconds of this machine
    """

    scatters: bool
    is_timed: bool

    def resolutions(self, scene: Scene) -> list[Resolution]:
        """All that may be refined."""
        ...

    def jitter(self, scene: Scene, factor: float) -> dict[str, Any]:
        """Settings that differ by a factor of refinement that means nothing."""
        ...

    def size(self, scene: Scene) -> Size:
        """Raises SceneError or GeometryError for a scene that is refused."""
        ...

    def acts_along_y(self, scene: Scene) -> bool:
        """Whether something moves along y but for what points of joints bring there."""
        ...

    def job(self, scene: Scene, settings: dict[str, Any], label: str) -> Job:
        """A run."""
        ...

    def measured(self, rows: Sequence[Row], base: Row, folder: Path) -> list[Row]:
        """Rows with what follows from their numbers and files."""
        ...

    def answers(self, base: Row, gauges: Sequence[str], of: Sequence[str]) -> list[Answer]:
        """The numbers whose error is asked."""
        ...


class RunAnalysis:
    """The numbers of a run."""

    scatters = is_timed = True

    def resolutions(self, scene: Scene) -> list[Resolution]:
        return resolutions_of(scene)

    def jitter(self, scene: Scene, factor: float) -> dict[str, Any]:
        return jitter(scene, factor)

    def size(self, scene: Scene) -> Size:
        assembly = assemble(scene)
        seconds = forecast(assembly).seconds[0]
        contacts = int(np.isin(assembly.model.group, assembly.model.swept).sum())
        return Size(seconds, contacts, assembly.specimen.blocks, assembly.joints, assembly.mesh is not None)

    def acts_along_y(self, scene: Scene) -> bool:
        return scene.acts_along_y

    def job(self, scene: Scene, settings: dict[str, Any], label: str) -> Job:
        return Job(scene, settings, label)

    def measured(self, rows: Sequence[Row], base: Row, folder: Path) -> list[Row]:
        return [with_derived(row, folder) for row in rows]

    def answers(self, base: Row, gauges: Sequence[str], of: Sequence[str]) -> list[Answer]:
        return answers_of(base, gauges, of)


@dataclass(frozen=True)
class ModesAnalysis:
    """Frequencies of modes, by their numbers from 1 on, the slowest first."""

    numbers: tuple[int, ...]
    scatters = is_timed = False

    def resolutions(self, scene: Scene) -> list[Resolution]:
        return of_space(scene)

    def jitter(self, scene: Scene, factor: float) -> dict[str, Any]:
        return {}

    def size(self, scene: Scene) -> Size:
        oscillator = oscillator_of(scene)
        dofs, blocks = len(oscillator.mass), oscillator.specimen.blocks
        seconds = 1.0 + (dofs / SMALL_SYSTEM) ** GROWTH
        return Size(seconds, len(oscillator.joints.area), blocks, oscillator.joints, oscillator.layout.mesh is not None)

    def acts_along_y(self, scene: Scene) -> bool:
        return True

    def job(self, scene: Scene, settings: dict[str, Any], label: str) -> Job:
        return Job(scene, settings, label, max(self.numbers) + BESIDE)

    def measured(self, rows: Sequence[Row], base: Row, folder: Path) -> list[Row]:
        """Rows whose modes have the numbers of those of the scene as it is that they are most alike."""
        if base["status"] != OK:
            return list(rows)
        shapes = _shapes(folder, base)[: max(self.numbers)]
        return [_renumbered(row, shapes, _shapes(folder, row)) if row["status"] == OK else row for row in rows]

    def answers(self, base: Row, gauges: Sequence[str], of: Sequence[str]) -> list[Answer]:
        numbers = [number for number in self.numbers if frequency_key(number) in base]
        return [Answer(frequency_key(number), f"frequency {number}", "Hz") for number in numbers]


RUN = RunAnalysis()


def analysis_of(of: Sequence[str]) -> RefinedAnalysis:
    """The analysis that has the numbers asked for: modes where these are frequencies, else a run. Raises SceneError
    where they are both, and for a frequency that is none."""
    alike = [name for name in of if name.startswith(("modes", "frequenc"))]
    if not alike:
        return RUN
    numbers = [int(match[1]) for name in alike if (match := FREQUENCY.fullmatch(name)) is not None]
    if len(numbers) < len(alike) or not all(1 <= number <= MOST for number in numbers):
        allowed = f"{frequency_key(1)} to {frequency_key(MOST)}, or --modes N"
        raise SceneError(f"--of: '{alike[0]:.60}' is no frequency; allowed: {allowed}")
    if len(alike) < len(of):
        raise SceneError("--of: frequencies need no run, and are refined apart from the numbers of one; leave one out")
    return ModesAnalysis(tuple(numbers))


def frequency_keys(count: int) -> list[str]:
    """Names of the frequencies of so many modes. Raises SceneError."""
    if not 1 <= count <= MOST:
        raise SceneError(f"{count} modes; allowed: 1 to {MOST}")
    return [frequency_key(number) for number in range(1, count + 1)]


def _shapes(folder: Path, row: Row) -> np.ndarray:
    """(m, 3 P) how the corners of the blocks move in each mode."""
    shapes = np.load(folder / "runs" / row["key"] / SHAPES)
    return np.asarray(shapes.reshape(len(shapes), -1))


def _renumbered(row: Row, base: np.ndarray, shapes: np.ndarray) -> Row:
    """A row in which each mode has the number of that of the scene as it is (m, 3 P) that moves most alike."""
    others = {key: value for key, value in row.items() if not key.startswith("modes.")}
    pairs = pairs_of(base, shapes)
    return others | {frequency_key(k + 1): row[frequency_key(n + 1)] for k, n in pairs.items()}


def pairs_of(base: np.ndarray, shapes: np.ndarray) -> dict[int, int]:
    """Number from 0 of each mode (m, d) and of the one among others (n, d) that it is, by the modal assurance criterion
    (R. J. Allemang and D. L. Brown, Proc. 1st Int. Modal Analysis Conference, 1982, 110): the cosine squared between
    two shapes; all pairs at once, so that none is paired twice."""
    from scipy.optimize import linear_sum_assignment

    length = np.outer((base**2).sum(axis=1), (shapes**2).sum(axis=1))
    first, second = linear_sum_assignment((base @ shapes.T) ** 2 / length, maximize=True)
    return dict(zip(first.tolist(), second.tolist(), strict=True))
