"""Content of summary.json, in SI: a record of one part after another. docs/results.md says what each number means.

Each part is made by a file of masonry/laboratory/summary/. None is what was not measured in a run, what
does not apply to it, and what an older version did not write.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, TypedDict

from masonry.errors import SceneError
from masonry.results.records.convergence_record import Refined
from masonry.results.records.element_record import WithElements
from masonry.results.records.laboratory_record import MeasuredBeside, StandardResults
from masonry.runtime.progress import duration
from masonry.runtime.record import Record, list_of, one_of, table_of
from masonry.runtime.text_files import json_of

Numbers = Mapping[str, float | None]
"""Numbers by name."""


@dataclass(frozen=True, eq=False)
class Description(Record):
    """Subject of a run; `left_out` is the load of [limit] in words, if the scene has runs leave it out on purpose."""

    scene: str | None = None
    law: str | None = None
    kinematics: str | None = None
    law_by_group: dict[str, str] | None = None
    kinematics_by_group: dict[str, str] | None = None
    blocks: int | None = None
    cells: list[dict[str, Any]] | None = None
    scatter: dict[str, Any] | None = None
    contacts: int | None = None
    tets: int | None = None
    freedoms: int | None = None
    section_m2: float | None = None
    left_out: str | None = None
    version: str | None = None
    source_hash: str | None = None


@dataclass(frozen=True, eq=False)
class Course(Record):
    """How the run went; `seconds`, of building, compiling and stepping, is that of a run of a sweep. Those of processor
    are of all threads, the others by the clock on the wall."""

    steps: int | None = None
    control: Numbers | None = None
    seconds_run: float | None = None
    seconds_compile: float | None = None
    seconds_processor_run: float | None = None
    seconds_processor_compile: float | None = None
    seconds: float | None = None
    time_step_s: float | None = None
    step_fraction: float | None = None
    interrupted: bool | None = None
    stopped: str | None = None

    @property
    def time(self) -> str:
        """Duration: `1.2 s run + 12 s compile; of processor 1.2 s + 12 s`."""
        processor = self.seconds_processor_run, self.seconds_processor_compile
        words = f"{_duration(self.seconds_run)} run + {_duration(self.seconds_compile)} compile"
        return words + ("" if None in processor else "; of processor {} + {}".format(*map(_duration, processor)))


@dataclass(frozen=True, eq=False)
class Readings(Record):
    """Of a gauge; of one of a velocity or an acceleration what it reads at the end (`final`), and its unit."""

    at_peak_m: float | None = None
    final_m: float | None = None
    final: float | None = None
    unit: str | None = None


@dataclass(frozen=True, eq=False)
class Extremes(Record):
    """Extremes met by the drive, and readings of the gauges."""

    peak_stress_pa: float | None = None
    displacement_at_peak_m: float | None = None
    final_stress_pa: float | None = None
    peak_force_n: float | None = None
    lowest_stress_pa: float | None = None
    displacement_at_lowest_m: float | None = None
    rise_at_end: float | None = None
    missed_between_steps: float | None = None
    cycles: list[dict[str, bool | float | None]] | None = None
    tilt_rad: float | None = None
    gauges: dict[str, Readings] | None = table_of(Readings)
    beside_measured: MeasuredBeside | None = one_of(MeasuredBeside)
    standard: StandardResults | None = one_of(StandardResults)


class Reaction(TypedDict, total=False):
    """Force and moment of a support, the drive or a load, and the part that they act on."""

    on: str
    force_n: list[float | None]
    moment_nm: list[float | None]


@dataclass(frozen=True, eq=False)
class Forces(Record):
    """Supports, drive and dead loads, at the peak and at the end, and how far their forces balance."""

    reactions: dict[str, dict[str, float | Reaction]] | None = None
    force_balance: float | None = None
    motion_at_end: float | None = None
    reaction_mismatch_max: float | None = None


@dataclass(frozen=True, eq=False)
class Energies(Record):
    """Energies and works, and how far they balance."""

    work_of_drive_j: float | None = None
    work_of_force_j: float | None = None
    work_of_loads_j: Numbers | None = None
    work_of_loads_after_settling_j: Numbers | None = None
    energy_j: Numbers | None = None
    energy_imbalance: float | None = None
    dissipation_mismatch: float | None = None
    kinetic_over_internal_max: float | None = None
    damping_over_external: float | None = None


@dataclass(frozen=True, eq=False)
class Restless(Record):
    """The block that is farthest from rest, where it was made, and its shares."""

    block: int = 0
    at_m: list[float] = field(default_factory=list)
    unbalanced: float | None = None
    kinetic: float | None = None


@dataclass(frozen=True, eq=False)
class Rest(Record):
    """How far from rest the specimen was after the settling, and at the end; how well its swings are followed."""

    unbalanced_after_settling: float | None = None
    kinetic_after_settling: float | None = None
    unrest_after_settling: Restless | None = one_of(Restless)
    moving_at_end: Restless | None = one_of(Restless)
    came_loose: str | None = None
    swing_too_wide: float | None = None


@dataclass(frozen=True, eq=False)
class SuddenCrack(Record):
    """A moment in which the specimen moved by itself."""

    displacement_m: float = 0.0
    released_j: float = 0.0
    first_step: int = 0
    last_step: int = 0
    place: str = ""


@dataclass(frozen=True, eq=False)
class Damage(Record):
    """Damage and compression: what broke, opened, slid and was pressed."""

    sudden_cracks: list[SuddenCrack] | None = list_of(SuddenCrack)
    released_over_dissipated: float | None = None
    released_over_work: float | None = None
    joints_opened_or_slid: int | None = None
    broken_area_m2: dict[str, float] | None = None
    damaged_area_m2: dict[str, float] | None = None
    symmetry_lost: str | None = None
    mode_2_over_law: float | None = None
    slip_max: float | None = None
    slip_limit: float | None = None
    compression_max_pa: float | None = None
    unit_compression_max_pa: float | None = None
    compression_over_strength: float | None = None


@dataclass(frozen=True, eq=False)
class Moment(Record):
    """A moment of a run: the drive, the tilt and the shares of loads that have a history."""

    step: int = 0
    time_s: float = 0.0
    displacement_m: float = 0.0
    force_n: float = 0.0
    tilt_rad: float | None = None
    loads: dict[str, float] | None = None


@dataclass(frozen=True, eq=False)
class FirstFall(Moment):
    """The first block that fell, at the moment at which it had."""

    block: int = 0
    sets: list[str] = field(default_factory=list)
    at_m: list[float] = field(default_factory=list)
    began: Moment | None = one_of(Moment)
    began_unknown: str | None = None
    blow_pa: float | None = None
    energy_j: dict[str, float] | None = None


@dataclass(frozen=True, eq=False)
class CollapseBranch(Record):
    """Outcome of the gauge that was to be led on behind a collapse, and where that ended."""

    gauge: str = ""
    until_m: float = 0.0
    ends: str = ""
    led: bool = False
    from_m: float = 0.0
    steps: int = 0
    leaps: int = 0
    out_of_balance_max: float = 0.0
    near_to_m: float = 0.0
    reached_m: float = 0.0
    factor_at_end: float = 0.0
    factor_max: float | None = None


@dataclass(frozen=True, eq=False)
class LoadLoops(Record):
    """The path of a load that goes to and fro, the gauge over which it is drawn, and the leg on which the run ended."""

    gauge: str = ""
    history: list[float] = field(default_factory=list)
    leg: int = 0


@dataclass(frozen=True, eq=False)
class CaughtFallRecord(Record):
    """A fall that came to rest: from which factor on, how far (m), and which block moved most."""

    borne: float = 0.0
    falls: float = 0.0
    travel_m: float = 0.0
    block: int = 0

    @property
    def words(self) -> str:
        """A line for an engineer."""
        return (
            f"{self.borne:.6g} is borne before it moves; at {self.falls:.6g} it moves by {1e3 * self.travel_m:.4g} mm "
            f"(block {self.block}) and rests"
        )


@dataclass(frozen=True, eq=False)
class CollapseLoad(Record):
    """The factor of a load that grew: the greatest that was borne, the least that was not, and who moves then."""

    pattern: str = ""
    borne: float = 0.0
    falls: float | None = None
    accuracy: float = 0.0
    trials: int = 0
    undecided: int = 0
    falls_by_turning: bool = False
    swayed_over_block: float | None = None
    moving: int = 0
    first: int = 0
    sets: list[str] = field(default_factory=list)
    moved: list[float] = field(default_factory=list)
    travel_m: float | None = None
    moves_from: float | None = None
    caught: list[CaughtFallRecord] | None = list_of(CaughtFallRecord)
    later_m: float | None = None
    branch: CollapseBranch | None = one_of(CollapseBranch)
    loops: LoadLoops | None = one_of(LoadLoops)


@dataclass(frozen=True, eq=False)
class GroundComponent(Record):
    """The motion of the ground along one axis: its peaks, and where it ends."""

    peak_acceleration_m_s2: float = 0.0
    peak_velocity_m_s: float = 0.0
    peak_displacement_m: float = 0.0
    residual_velocity_m_s: float = 0.0
    residual_displacement_m: float = 0.0
    duration_s: float = 0.0


@dataclass(frozen=True, eq=False)
class GaugeSwing(Record):
    """How far a gauge went from what it read when the dead loads had settled (m, m/s, m/s2), and what is left."""

    quantity: str = "displacement"
    peak: float = 0.0
    time_s: float = 0.0
    least: float = 0.0
    most: float = 0.0
    residual: float = 0.0
    height_m: float | None = None
    peak_drift: float | None = None
    residual_drift: float | None = None


@dataclass(frozen=True, eq=False)
class Uplift(Record):
    """The widest that a joint opened, until a block had fallen."""

    opening_m: float = 0.0
    time_s: float = 0.0
    between: str = ""
    at_m: list[float] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class LargestForce(Record):
    """The largest force between two blocks."""

    force_n: float = 0.0
    time_s: float = 0.0
    between: str = ""


@dataclass(frozen=True, eq=False)
class Shaking(Record):
    """Motion of the ground, and its effect on the specimen; times are those since the settling."""

    settled_s: float = 0.0
    ground: dict[str, GroundComponent] | None = table_of(GroundComponent)
    gauges: dict[str, GaugeSwing] | None = table_of(GaugeSwing)
    uplift: Uplift | None = one_of(Uplift)
    largest_force: LargestForce | None = one_of(LargestForce)
    input_energy_j: float | None = None
    kinetic_at_end: float | None = None
    moves_supports: bool = False
    rows_a_second: float | None = None


@dataclass(frozen=True, eq=False)
class MovedDrive(Record):
    """The largest velocity and acceleration of a drive in real time, from step to step."""

    peak_velocity_m_s: float = 0.0
    peak_acceleration_m_s2: float = 0.0


@dataclass(frozen=True, eq=False)
class Movements(Record):
    """How far blocks moved, what they met, and what fell."""

    rotation_max_rad: float | None = None
    overlap_max: float | None = None
    met: str | None = None
    in_real_time: bool | None = None
    damping_after_settling: str | None = None
    free_swings: dict[str, Any] | None = None
    collapse: FirstFall | None = one_of(FirstFall)
    collapse_load: CollapseLoad | None = one_of(CollapseLoad)
    shaking: Shaking | None = one_of(Shaking)
    drive: MovedDrive | None = one_of(MovedDrive)


@dataclass(frozen=True, eq=False)
class Trust(Record):
    """How far to trust the numbers."""

    verdict: str | None = None
    doubts: list[dict[str, Any]] | None = None
    not_measured: list[str] | None = None
    warnings: list[str] | None = None


@dataclass(frozen=True, eq=False)
class Summary(Refined, Trust, WithElements, Movements, Damage, Rest, Energies, Forces, Extremes, Course, Description):
    """All of it; the fields of the last part come first."""


def _duration(seconds: float | None) -> str:
    return "not known" if seconds is None else duration(seconds)


JUDGED = frozenset(entry.name for entry in fields(Trust))
"""Keys of the judgement: one that cannot be read is made again from the other keys."""


def read_summary(path: Path) -> dict[str, Any]:
    """The keys of summary.json. Raises SceneError where it is damaged: a value of another type than it should have."""
    table = json_of(path)
    if not isinstance(table, dict):
        raise SceneError(f"'{path}' is damaged (not a table of keys and values); run the scene again")
    Summary.require({key: value for key, value in table.items() if key not in JUDGED}, f"'{path}'")
    return table
