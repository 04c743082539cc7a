"""The result of a run as data: its summary, history and specimen."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np

from geometry.blocks import Joints, Specimen, TetMesh
from masonry.errors import SceneError
from masonry.judgement.doubt import Doubt
from masonry.judgement.evidence import has_drive
from masonry.judgement.judgement import judgement_of
from masonry.judgement.sentence import trust
from masonry.results.summary import Summary
from masonry.results.table import table_of
from masonry.rows.history import History
from masonry.rows.peak import before_a_collapse, peak_row
from masonry.runtime.finite import finite_rows, is_finite, without_nan
from masonry.runtime.text_files import toml_of

if TYPE_CHECKING:
    from pandas import DataFrame

    from masonry.laws.state import JointProperties


class Peak(NamedTuple):
    """Displacement of the drive (m) and stress (Pa) there."""

    displacement: float
    stress: float


def properties_by_group(groups: Sequence["JointProperties"]) -> dict[str, np.ndarray]:
    """The joint properties of a result."""
    from masonry.laws.state import JointProperties  # a result is read and drawn without numba

    by_name = {name: [getattr(joint, name) for joint in groups] for name in JointProperties._fields}
    return {
        name: np.array([np.nan if value is None else float(np.mean(value)) for value in values])
        for name, values in by_name.items()
    }


@dataclass(repr=False)
class ResultData:
    """Data that a run leaves behind.

    summary       numbers and words of summary.json; a table of them becomes one
    joint_group   (C,) index into joint_groups, the contact group of each contact point
    joint_properties  (G,) SI by the names of JointProperties, of each contact group: the mean where it scatters, nan
                  where a law has none; empty in a result of an older version
    mesh          tets, None where every block is rigid or affine
    scene_toml    the resolved scene: enough to run it again
    log           what the run had to say, one sentence each
    resultants    column by column, what each joint between units carries at the peak and at the end
    """

    summary: Summary
    history: History
    specimen: Specimen
    joints: Joints
    joint_group: np.ndarray
    joint_groups: tuple[str, ...]
    mesh: TetMesh | None = None
    scene_toml: str = ""
    log: list[str] = field(default_factory=list)
    resultants: dict[str, np.ndarray] = field(default_factory=dict)
    joint_properties: dict[str, np.ndarray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not isinstance(self.summary, Summary):
            self.summary = Summary.read(self.summary)

    @property
    def title(self) -> str:
        """The scene's title, or its name where it has none."""
        return str(self.scene_table.get("title") or self.summary.scene or "masonry")

    @property
    def scene_table(self) -> dict[str, Any]:
        """The resolved scene as it was read, not checked; empty where it cannot be read."""
        try:
            return toml_of(self.scene_toml, "scene")
        except SceneError:
            return {}

    @property
    def is_large(self) -> bool:
        """Whether it was run in large displacement, in which blocks turn, part and meet anew."""
        return bool(self.scene_table.get("displacements") == "large")

    @property
    def has_drive(self) -> bool:
        """Whether something is driven; where nothing is, there are reactions and gauges, but no curve and no peak."""
        return has_drive(self.summary)

    @property
    def in_real_time(self) -> bool:
        """Whether masses are real, and the run is a motion in time."""
        return bool(self.summary.in_real_time)

    @property
    def is_shaken(self) -> bool:
        """Whether the ground moves."""
        return self.summary.shaking is not None

    @property
    def time_origin(self) -> float:
        """s, of the first step: from when pictures and words count the time. Where the ground moves that is the end of
        the settling."""
        return 0.0 if self.summary.shaking is None else self.summary.shaking.settled_s

    @property
    def curve(self) -> "DataFrame":
        """The rows, one a moment, in SI units (`curve.attrs["units"]`): `curve["displacement"]`, `curve["stress"]`,
        gauges, energies; the first two where there is a drive. A table of pandas; without pandas a SceneError, and
        `history.rows` has the same columns.
        """
        return table_of(self.history, self.has_drive)

    @property
    def peak(self) -> Peak:
        """`peak.stress` (Pa) and `peak.displacement` (m) of the drive: the largest of all steps, not of rows, before
        a block had fallen; of a drive that turns back the largest of rows; nan where nothing is driven."""
        if not self.has_drive:
            return Peak(math.nan, math.nan)
        at, stress = self.summary.displacement_at_peak_m, self.summary.peak_stress_pa
        if at is not None and stress is not None:
            return Peak(at, stress)
        rows = self.standing_rows
        row = peak_row(rows)
        return Peak(float(rows["displacement"][row]), float(rows["stress"][row]))

    @property
    def standing_rows(self) -> dict[str, np.ndarray]:
        """The rows at which no block had fallen, and that at which the first one had; all where none falls."""
        fallen = self.summary.collapse
        return before_a_collapse(self.history.rows, None if fallen is None else fallen.step)

    @property
    def energies(self) -> dict[str, float]:
        """The energy ledger at the end, J: external work, what is stored, what was dissipated and how; nan where a
        number is not known."""
        return {key: math.nan if value is None else value for key, value in (self.summary.energy_j or {}).items()}

    @property
    def verdict(self) -> str:
        """How far to trust the numbers, in a word: "sound", "with care", or "stopped" before the end."""
        return judgement_of(self.summary).verdict

    @property
    def doubts(self) -> tuple[Doubt, ...]:
        """Doubts about the numbers, the largest first: name, value, limit, sentence, advice."""
        return judgement_of(self.summary).doubts

    @property
    def trust(self) -> str:
        """How far to trust the numbers, in a sentence that begins with the verdict."""
        return trust(self.summary)

    def finite(self) -> Self:
        """The same without what is not finite: rows from the first bad one on go, so do bad frames; summary values
        become null. Each loss is a line of the log."""
        log = list(self.log)
        rows, last_step = finite_rows(self.history.rows, log)
        frames = [frame for frame in self.history.frames if is_finite(frame) and frame.step <= last_step]
        if len(frames) < len(self.history.frames):
            log.append(f"{len(self.history.frames) - len(frames)} frames with values that are not finite were dropped")
        summary = Summary.read({key: without_nan(value, key, log) for key, value in self.summary.items()})
        return replace(self, summary=summary, history=replace(self.history, rows=rows, frames=frames), log=log)
