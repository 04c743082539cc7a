"""The numbers of a run whose error is asked: which there are, what of a row they are, and their words."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from masonry.errors import SceneError
from masonry.laboratory.result import load_result
from masonry.rows.columns import CRUSHING, DASHPOT, FACTOR, TAKEN_BY_ELEMENTS
from masonry.rows.columns import DISSIPATED as DISSIPATED_BY_JOINTS
from masonry.sweeps.measured_number import is_measured, require_number
from masonry.sweeps.run_store import Row
from masonry.sweeps.work import OK

BORNE, FALLS = "collapse_load.borne", "collapse_load.falls"
STIFFNESS, DISSIPATED, CRUSHED = "initial_stiffness_pa_per_m", "dissipated_j", "largest_crushing_m"
DERIVED = (STIFFNESS, DISSIPATED, CRUSHED)
"""Numbers that follow from the curve, the energies and the fields of a run."""
CRUSHING_ENERGY = f"energy_j.{CRUSHING}"
LOSSES = tuple(f"energy_j.{column}" for column in (*DISSIPATED_BY_JOINTS, CRUSHING, DASHPOT, *TAKEN_BY_ELEMENTS))
MISSED = "missed_between_steps"
PLACE, ROWS_APART = "displacement_at_peak_m", "rows_apart_at_peak"
SETTINGS = (
    *("time_step_s", "step_fraction", "section_m2", "slip_limit", "collapse_load.accuracy"),
    *("collapse_load.branch.until_m", "shaking.rows_a_second", MISSED),
)
LIMIT, EXACT = (
    ("factor", "load_factor", "limit"),
    "the factor of masonry limit has nothing to refine: corners of joints bear whatever a pressure bears, and the "
    "optimum is exact but for its duality gap",
)
"""Names of the factor of a limit analysis, and why it has no error of resolution."""
NEARLY = 0.99
"""Fraction of the peak from which on a row beside it may be the peak as well."""
ELASTIC = 0.1
"""Fraction of the peak up to which the secant of a curve is its initial stiffness."""
NOTHING = 1e-6
"""Fraction of the largest number of the same unit, below which a number is none."""


@dataclass(frozen=True)
class Answer:
    """key  of a row, words and unit for people, and the factor from SI to that unit."""

    key: str
    words: str
    unit: str = ""
    factor: float = 1.0


ANSWERS = (
    Answer("peak_stress_pa", "peak", "MPa", 1e-6),
    Answer(PLACE, "displacement there", "mm", 1e3),
    Answer("final_stress_pa", "end stress", "MPa", 1e-6),
    Answer(STIFFNESS, "initial stiffness", "MPa/mm", 1e-9),
    Answer(BORNE, "load factor"),
    Answer(DISSIPATED, "dissipated energy", "J"),
    Answer(CRUSHED, "largest crushing", "mm", 1e3),
)
BEHIND_GAUGES = {
    "gauges.{}.at_peak_m": ("{} at the peak", "mm", 1e3),
    "gauges.{}.final_m": ("{} at the end", "mm", 1e3),
    "shaking.gauges.{}.peak": ("largest {}", "", 1.0),
    "shaking.gauges.{}.residual": ("residual {}", "", 1.0),
    "shaking.gauges.{}.peak_drift": ("largest drift of {}", "%", 100.0),
    "shaking.gauges.{}.residual_drift": ("residual drift of {}", "%", 100.0),
}
"""Numbers that each gauge of a scene has, and their words."""


@dataclass(frozen=True)
class Value:
    """A number of a run, and the half-width of the interval of which it is the lower end: of a load factor between what
    was borne and what fell, of a peak between steps; and by how much it is read off to both sides, where it is the
    place of a row."""

    number: float
    interval: float = 0.0
    reading: float = 0.0

    @property
    def middle(self) -> float:
        """Of the interval, which counts as the value."""
        return self.number + self.interval


def answers_of(row: Row, gauges: Sequence[str], chosen: Sequence[str] = ()) -> list[Answer]:
    """Those of `chosen`, keys of a row; else all that the run of a row has and that are not next to nothing beside
    others of their unit."""
    if chosen:
        known = {answer.key: answer for answer in (*ANSWERS, *_of_gauges(gauges))}
        alike = [abs(value) for key, value in row.items() if key.startswith("gauges.") and isinstance(value, float)]
        nothing = NOTHING * max(alike, default=0.0)
        return [
            known.get(key, Answer(key, key)) for key in chosen if abs(row.get(key) or 0.0) > nothing * is_gauge(key)
        ]
    there = [answer for answer in (*ANSWERS, *_of_gauges(gauges)) if isinstance(row.get(answer.key), float)]
    if row.get(FALLS) is None:  # the factor is where the scene ends, and no answer
        there = [answer for answer in there if answer.key != BORNE]
    largest: dict[str, float] = {}
    for answer in there:
        largest[answer.unit] = max(largest.get(answer.unit, 0.0), abs(row[answer.key]))
    return [answer for answer in there if abs(row[answer.key]) > NOTHING * largest[answer.unit]]


def require_answer(name: str, gauges: Sequence[str]) -> None:
    """Raise SceneError where no run has such a number, and for one that no refinement brings nearer to anything: what
    counts something, what tells the time that a run took, and a setting."""
    if name in DERIVED:
        return
    if name.partition(".")[0] in LIMIT:
        raise SceneError(f"--of: '{name:.60}': {EXACT}")
    require_number(name, gauges, "--of: ", "it")
    if name.startswith("seconds") or name in SETTINGS or not is_measured(name, gauges):
        usual = ", ".join(answer.key for answer in ANSWERS[:4])
        raise SceneError(
            f"--of: '{name}' is a count, a time of processor or a setting, which has no value without end; others have "
            f"one, such as {usual}"
        )


def is_gauge(key: str) -> bool:
    """Whether a number is the displacement of a gauge, which may be 0 but for rounding, as nothing acts along it."""
    return key.startswith("gauges.")


def _of_gauges(gauges: Sequence[str]) -> list[Answer]:
    return [
        Answer(key.format(name), words.format(name), unit, factor)
        for key, (words, unit, factor) in BEHIND_GAUGES.items()
        for name in gauges
    ]


def with_derived(row: Row, folder: Path) -> Row:
    """A row with what follows from its numbers and its files: dissipated energy, initial stiffness, crushing."""
    parts = [row[key] for key in LOSSES if isinstance(row.get(key), float)]
    derived = {DISSIPATED: sum(parts)} if parts and row.get(FALLS) is None else {}  # what falls dissipates on
    if row["status"] != OK:
        return row | derived
    run = folder / "runs" / row["key"]
    apart = _rows_apart_at_peak(run, row[PLACE]) if row.get(PLACE) else None
    others = {
        STIFFNESS: _initial_stiffness(run),
        ROWS_APART: apart,
        CRUSHED: _largest_crushing(run) if CRUSHING_ENERGY in row else None,
    }
    return row | derived | {key: number for key, number in others.items() if number is not None}


def _largest_crushing(folder: Path) -> float | None:
    """m, the largest plastic closing of a contact at the end; None where no frame of a run is there."""
    try:
        frames = load_result(folder).history.frames
    except SceneError:
        return None
    crushing = frames[-1].crushing if frames else None
    return None if crushing is None or not len(crushing) else float(crushing.max())


def _initial_stiffness(folder: Path) -> float | None:
    """Pa/m, the secant from the start of the drive to ELASTIC of the largest stress; None where there is no such."""
    try:
        rows = load_result(folder).history.rows
    except SceneError:
        return None
    if "displacement" not in rows or FACTOR in rows:
        return None
    way, stress = rows["displacement"], rows["stress"]
    begun = int(np.argmax(way != 0.0)) - 1
    if begun < 0:
        return None
    rise, moved = stress[begun:] - stress[begun], way[begun:] - way[begun]
    later = np.nonzero(np.abs(rise) >= ELASTIC * np.max(np.abs(rise)))[0]
    if not np.max(np.abs(rise)) or moved[later[0]] == 0.0:
        return None
    return float(rise[later[0]] / moved[later[0]])


def _rows_apart_at_peak(folder: Path, place: float) -> float | None:
    """How far from its row the peak may lie, over the displacement there: up to the next row, as it is seen once it is
    passed, and up to the one before where that bears nearly as much."""
    try:
        rows = load_result(folder).history.rows
        way, stress = rows["displacement"], np.abs(rows["stress"])
    except (SceneError, KeyError):
        return None
    at = int(np.argmin(np.abs(way - place)))
    apart = [
        abs(way[k] - way[at]) for k in (at + 1, at - 1) if 0 <= k < len(way) and (k > at or _is_flat(stress, k, at))
    ]
    return float(max(apart, default=0.0) / abs(place))


def _is_flat(stress: np.ndarray, row: int, peak: int) -> bool:
    return bool(stress[row] >= NEARLY * stress[peak])


def value_of(row: Row, answer: Answer) -> Value | None:
    """The number of a run; None where it has none."""
    number = row.get(answer.key)
    if row["status"] != OK or not isinstance(number, int | float):
        return None
    higher = 0.0
    if answer.key == BORNE and row.get(FALLS) is not None:
        higher = row[FALLS] - number
    elif answer.key == "peak_stress_pa":
        higher = abs(number) * (row.get(MISSED) or 0.0)
    is_place = answer.key == PLACE or answer.key.endswith(".at_peak_m")
    reading = abs(number) * (row.get(ROWS_APART) or 0.0) if is_place else 0.0
    return Value(float(number), 0.5 * higher, reading)
