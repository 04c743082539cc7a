"""A scene and its variants, run side by side: what came of each, and how far that is from the scene as it is."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from masonry.judgement.sentence import trust
from masonry.results.summary import read_summary
from masonry.rows.columns import CRUSHING, DASHPOT, DISSIPATED, TAKEN_BY_ELEMENTS
from masonry.runtime.progress import Tell
from masonry.scene import Scene
from masonry.sweeps.engine import run_alone
from masonry.sweeps.job import Job
from masonry.sweeps.run_store import Row
from masonry.sweeps.sensitivity.variants import Variant
from masonry.sweeps.study_folder import SCENE
from masonry.sweeps.work import OK

TABLE = "sensitivity.json"
DOING = "compares variants of a scene in it"
LOSSES = tuple(f"energy_j.{column}" for column in (*DISSIPATED, CRUSHING, DASHPOT, *TAKEN_BY_ELEMENTS))
"""Energies that are dissipated, of those that a run has."""


@dataclass(frozen=True)
class Figure:
    """Quantity that is compared: its key, its name and unit for people, and the factor from SI."""

    key: str
    name: str
    unit: str
    factor: float


FIGURES = (
    Figure("peak_stress_pa", "peak", "MPa", 1e-6),
    Figure("displacement_at_peak_m", "at", "mm", 1e3),
    Figure("final_stress_pa", "end", "MPa", 1e-6),
    Figure("collapse_load.borne", "load factor", "", 1.0),
    Figure("dissipated_j", "dissipated", "J", 1.0),
)
NOTHING = 1e-9
"""Share of the base's largest value of the same unit, below which it is 0 and no deviation is told."""


def study(
    scene: Scene,
    folder: Path,
    chosen: Sequence[Variant],
    workers: int,
    tell: Tell | None = None,
) -> list[dict[str, Any]]:
    """Run a scene in each of the ways into a folder that `begin` has prepared; a row for each, the base first.

    A row holds variant, kind, settings, status, verdict, doubts (their names), trust_sentence, seconds, key of
    `folder/runs/KEY`, the figures in SI and, as `KEY_deviation`, their relative deviations from the base; None where
    there is none. Runs that are there already are not run again. For one who holds the folder (`lock.sole`).
    """
    jobs = [Job(folder / SCENE, variant.settings, variant.name) for variant in chosen]
    ended = run_alone(jobs, folder, workers, tell)
    rows = [_row(variant, row, folder) for variant, row in zip(chosen, ended, strict=True)]
    for row in rows:
        row |= _deviations(row, rows[0])
    return rows


def _row(variant: Variant, ended: Row, folder: Path) -> dict[str, Any]:
    parts = [ended[key] for key in LOSSES if isinstance(ended.get(key), float)]
    numbers: dict[str, Any] = {figure.key: ended.get(figure.key) for figure in FIGURES}
    numbers["dissipated_j"] = sum(parts) if parts else None
    return {
        "variant": variant.name,
        "kind": variant.kind,
        "settings": variant.settings,
        "status": ended["status"],
        "verdict": ended["verdict"],
        "doubts": ended["doubts"],
        "trust_sentence": _trust(ended, folder),
        **numbers,
        "steps": ended.get("steps"),
        "seconds": ended["seconds"],
        "key": ended["key"],
    }


def _trust(ended: Row, folder: Path) -> str:
    """The sentence that the run's own summary would have, or why there is none."""
    if ended["status"] != OK:
        return str(ended["reason"])
    return trust(read_summary(folder / "runs" / ended["key"] / "summary.json"))


def word_of(row: Row) -> str:
    """Outcome of a run, in a word: its verdict, or its status where it did not come to its end."""
    return str(row["verdict"] if row["status"] == OK else row["status"].lower())


def _deviations(row: dict[str, Any], base: dict[str, Any]) -> dict[str, float | None]:
    largest: dict[str, float] = {}
    for figure in FIGURES:
        largest[figure.unit] = max(largest.get(figure.unit, 0.0), abs(base.get(figure.key) or 0.0))
    deviations: dict[str, float | None] = {}
    for figure in FIGURES:
        here, there = row.get(figure.key), base.get(figure.key)
        deviations[f"{figure.key}_deviation"] = None
        if here is not None and there is not None and abs(there) > NOTHING * largest[figure.unit]:
            deviations[f"{figure.key}_deviation"] = here / there - 1.0
    return deviations
