"""What to call each of many jobs in the lines that say how far they are."""

from collections.abc import Sequence
from typing import Any

from masonry.sweep.job import Job


def names(jobs: Sequence[Job]) -> list[str]:
    """Of each job its label, else the settings in which it differs from the others, or the scene."""
    keys = dict.fromkeys(key for job in jobs for key in job.settings)
    varied = [key for key in keys if len({repr(job.settings.get(key)) for job in jobs}) > 1]
    scenes = len({str(job.scene) for job in jobs}) > 1 or not varied
    return [job.label or " ".join([str(job.scene)] * scenes + _settings(job, varied)) for job in jobs]


def _settings(job: Job, keys: Sequence[str]) -> list[str]:
    return [f"{key.rsplit('.', 1)[-1]}={_short(job.settings[key])}" for key in keys if key in job.settings]


def _short(value: Any) -> str:
    """A value with four digits: a name is no place for more."""
    if isinstance(value, float):
        return f"{value:.4g}"
    number, space, unit = value.partition(" ") if isinstance(value, str) else (value, "", "")
    return f"{float(number):.4g} {unit}" if space and _is_number(number) else f"{value}"


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
