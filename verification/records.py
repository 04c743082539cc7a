"""records.json: one record per case and quantity, kept by version; what a new run finds replaces only its own."""

import json
import math
import os
import platform
from collections.abc import Iterable
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from geometry.files.atomic import WholeFiles
from geometry.operating_system import SYSTEM
from masonry import __version__
from masonry.errors import SceneError
from masonry.jit.sources import source_hash
from masonry.runtime.folder import require_writable as can_be_written
from masonry.runtime.folder import writing
from masonry.runtime.text_files import JSON_LARGEST, json_in, text_of
from verification.outcome import CaseOutcome

NAME = "records.json"
PACKAGES = ("numpy", "scipy", "numba", "gmsh", "scikit-fem")
WORDS = ("version", "source_hash", "chapter", "case", "status", "reason", "quantity", "unit", "kind_of_reference",
         "knob", "rung", "processor")  # fmt: skip
MEASURED = ("value", "reference", "tolerance", "scale", "seconds", "seconds_stepping")
"""What records are compared by: words (or plain numbers), and numbers; either may be missing."""
CASES = "Cases"
"""The chapter of a record that comes from a case."""
Record = dict[str, Any]


@cache
def origin() -> Record:
    """Origin of a number besides its case: sources, packages, processor. The same in every record of a run."""
    return {
        "version": __version__,
        "source_hash": source_hash(),
        "reference_hash": source_hash(("verification",)),
        "packages": {"python": platform.python_version(), **{name: metadata.version(name) for name in PACKAGES}},
        "processor": SYSTEM.processor_name(),
        "cores": os.cpu_count(),
    }


def records_of(outcome: CaseOutcome) -> list[Record]:
    """A record for each check of a case; one without a quantity where there is none (not built, error)."""
    case, findings = outcome.case, outcome.findings
    measures = {key: _largest(run.get(key) for run in findings.measures.values()) for key in _KEYS}
    common: Record = {
        "chapter": CASES,
        "case": case.name,
        "row": case.row,
        "area": case.area,
        "status": outcome.status,
        "reason": outcome.reason,
        "knobs": {},
        "seconds": finite(outcome.seconds),
        "seconds_stepping": finite(sum(findings.seconds.values())),
        **measures,
        "energy_imbalance": _largest(findings.imbalance.values()),
    }
    numbers = [
        {
            "quantity": check.quantity,
            "unit": check.unit,
            "value": finite(check.value),
            "reference": finite(check.reference),
            "kind_of_reference": check.tolerance.kind,
            "error": finite(check.error),
            "tolerance": check.tolerance.limit,
            "expected": check.tolerance.expected,
            "scale": finite(abs(check.reference) if check.scale is None else check.scale),
            "holds": bool(check.holds),
            "too_loose": bool(check.too_loose),
        }
        for check in findings.checks
    ]
    return [common | number | origin() for number in numbers or [{"quantity": None}]]


_KEYS = ("steps", "kinetic_over_internal", "unbalanced")


def _largest(values: Iterable[float | None]) -> float | None:
    """The largest of those that are known."""
    known = [float(v) for v in values if v is not None and math.isfinite(v)]
    return max(known, default=None)


def finite(value: float) -> float | None:
    """A number as strict JSON knows it."""
    return float(value) if math.isfinite(value) else None


def version_of(record: Record) -> tuple[str, str]:
    """Version of the program to which a record belongs: the same pair for records of one version."""
    return str(record.get("version")), str(record.get("source_hash"))


def load(path: Path) -> list[Record]:
    """The records of a file, oldest version first. Raises SceneError where it is no such file."""
    try:
        text = text_of(path, JSON_LARGEST)
    except SceneError as error:
        reason = str(error).removeprefix(f"'{path}' ")
        raise SceneError(f"cannot read records from '{path}': {reason}") from None
    records = json_in(text, f"'{path}' holds no records, it")
    fine = isinstance(records, list) and all(isinstance(r, dict) and "case" in r and "version" in r for r in records)
    if not fine:
        raise SceneError(f"'{path}' holds no records: give a records.json that `masonry verify --out` wrote")
    for number, record in enumerate(records, start=1):
        for name in (*WORDS, *MEASURED):
            value = record.get(name)
            if value is not None and not isinstance(value, (str, int, float) if name in WORDS else (int, float)):
                need = "a word" if name in WORDS else "a number"
                raise SceneError(f"'{path}', record {number}: {name}: must be {need}, not {value!r:.60}")
    return records


def merged(old: list[Record], new: list[Record]) -> list[Record]:
    """Old and new: of the same version, chapter and case only the new ones stay; all else is kept, and stays first."""
    replaced = {(*version_of(r), r.get("chapter"), r["case"]) for r in new}
    others = [r for r in old if (*version_of(r), r.get("chapter"), r["case"]) not in replaced]
    return others + new


def done(folder: Path) -> set[str]:
    """The cases that hold by their records in the folder, of this version and processor. Raises as `load`."""
    path, mine = folder / NAME, origin()
    same = ("version", "source_hash", "reference_hash", "processor")
    records = load(path) if path.exists() else []
    passed = [r for r in records if r.get("chapter") == CASES and r.get("status") in ("PASS", "NOT BUILT")]
    return {r["case"] for r in passed if all(r.get(key) == mine[key] for key in same)}


def require_writable(folder: Path) -> None:
    """Raise SceneError where records could not be saved to the folder; nothing is left there that was not."""
    existed = folder.exists()
    with writing(folder, "records"):
        folder.mkdir(parents=True, exist_ok=True)
        can_be_written(folder)
        if not existed:
            folder.rmdir()
    if (folder / NAME).is_symlink():
        raise SceneError(f"'{folder / NAME}' is a link, and would be replaced: move it, or name another folder")
    if (folder / NAME).exists():
        load(folder / NAME)


def save(new: list[Record], folder: Path) -> Path:
    """Put records beside those that are in the folder already: whole or not at all. Returns the path."""
    path = folder / NAME
    with writing(folder, "records"):
        together = merged(load(path) if path.exists() else [], new)
        lines = ",\n".join(json.dumps(record, allow_nan=False) for record in together)
        with WholeFiles(folder) as files:
            files.text(NAME, f"[\n{lines}\n]\n")
    return path
