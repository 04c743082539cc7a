"""Finite part of a result: rows, frames and values of the summary; what is lost becomes a line of its log."""

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

from masonry.rows.history import Frame


def finite_rows(rows: dict[str, np.ndarray], log: list[str]) -> tuple[dict[str, np.ndarray], float]:
    """The rows before the first that is not finite, and the last step that frames may have."""
    if not rows:
        return {}, math.inf
    good = np.logical_and.reduce([np.isfinite(values) for values in rows.values()])
    if good.all():
        return dict(rows), math.inf
    first = int(np.argmin(good))
    bad = ", ".join(name for name, values in rows.items() if not np.isfinite(values[first]))
    log.append(f"{len(good) - first} rows were dropped: from row {first + 1} on, {bad} is not finite")
    finite = {name: values[:first] for name, values in rows.items()}
    return finite, float(finite["step"][-1]) if first and "step" in finite else -math.inf


def is_finite(frame: Frame) -> bool:
    """Whether all numbers of a frame are."""
    numbers = (getattr(frame, entry.name) for entry in fields(frame))
    return all(np.isfinite(array).all() for array in numbers if array is not None)


def without_nan(value: Any, key: str, log: list[str]) -> Any:
    """A value of the summary with None in place of what is not finite."""
    if isinstance(value, Mapping):
        return {name: without_nan(entry, f"{key}.{name}", log) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [without_nan(entry, key, log) for entry in value]
    if isinstance(value, float | np.floating) and not math.isfinite(value):
        log.append(f"summary: {key} is not finite and was left empty")
        return None
    return value
