"""Which of the kept frames of a result is meant: that of the peak or the lowest stress, an end, or the nearest."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from masonry.errors import SceneError, did_you_mean
from masonry.rows.columns import FACTOR
from masonry.rows.history import Frame
from masonry.rows.peak import lowest_row, peak_row

if TYPE_CHECKING:
    from masonry.results.data import ResultData

NOISE = 1e-9
"""What is smaller than this share of the largest value is written as 0."""
WORDS = ("peak", "lowest", "last", "first")


@dataclass(frozen=True)
class Chosen:
    """A frame, what it is called in a title, and a sentence where it is not just what was asked for, else nothing."""

    frame: Frame
    name: str
    note: str = ""


def uncaught_fall(result: "ResultData") -> int | None:
    """The step at which the first block of a shaken specimen had fallen, where no floor catches what falls."""
    fallen = result.summary.collapse if result.is_shaken and "floor" not in result.scene_table else None
    return None if fallen is None else fallen.step


def choose(result: "ResultData", step: str | int | float = "peak") -> Chosen:
    """The frame nearest to what is asked.

    step  "peak", "lowest" (the lowest stress, of a drive that turns back), "last", "first", a number of a step, a
          displacement of the drive: text with a unit ("0.05 mm"), or a float in m; or, of a run in real time, a time:
          text with a unit ("1.2 s"), from the first step, or from the end of the settling where the ground moves.
          Of several frames at a displacement the first is meant.

    Raises SceneError for other words, where there are no frames, for "lowest" where no stress was below zero, for a
    displacement where nothing is driven, and for a time where the run is not one in real time.
    """
    frames = result.history.frames
    if not frames:
        raise SceneError("this result has no frames: its run ended before there was one; there is nothing to draw")
    if step == "last":
        return Chosen(frames[-1], "at the end")
    if step == "first":
        return Chosen(frames[0], "at the start")
    if step == "peak":
        return _at_peak(result)
    if step == "lowest":
        return _at_lowest(result)
    requested, of_frames, exact = _measure(step, result)
    chosen = int(np.argmin(np.abs(of_frames - requested)))
    frame = frames[chosen]
    name = moment(result, frame) if result.in_real_time else f"at step {frame.step}"
    if abs(of_frames[chosen] - requested) <= exact:
        return Chosen(frame, name)
    moved = np.array([frame.displacement for frame in frames])
    words = [f"step {frame.step}", *([moment(result, frame)] if result.in_real_time else [])]
    words += [f"displacement {without_noise(frame.displacement, moved) * 1e3:.4g} mm"] if result.has_drive else []
    note = (
        f"no frame was kept at '{step}'; the nearest of {len(frames)} is drawn: {', '.join(words)} "
        "(a run keeps more with --set solver.frames=100)"
    )
    target = f"step {step}" if result.in_real_time and str(step).strip().isdecimal() else step
    return Chosen(frame, f"{name}, the nearest kept to {target}", note)


def moment(result: "ResultData", frame: Frame) -> str:
    """When a frame was taken, in words: the time in a run in real time, the factor of a load that grows, else the
    step."""
    if result.in_real_time:
        return f"after {frame.time - result.time_origin:.4g} s"
    factor = load_factor_at(result, frame)
    return f"step {frame.step}" if factor is None else f"load factor {factor:.4g}"


def load_factor_at(result: "ResultData", frame: Frame) -> float | None:
    """The factor of a load that grows, in a frame; None where none grows."""
    rows = result.history.rows
    return float(np.interp(frame.step, rows["step"], rows[FACTOR])) if len(rows.get(FACTOR, ())) else None


def at_peak(result: "ResultData") -> Frame:
    """The frame nearest to the row of the peak (cycles.peak_row); the last one without rows or without a drive."""
    rows, frames = result.standing_rows, result.history.frames
    if not (len(rows.get("stress", ())) and result.has_drive):
        return frames[-1]
    return _nearest(frames, rows["step"][peak_row(rows)])


def at_stronger_side(result: "ResultData") -> Frame:
    """The same; of a drive that turns back the frame nearest to its lowest stress, where that is the larger one."""
    lowest = result.summary.lowest_stress_pa
    rows = result.standing_rows
    if not result.summary.cycles or lowest is None or -lowest <= result.peak.stress or not len(rows.get("stress", ())):
        return at_peak(result)
    return _nearest(result.history.frames, rows["step"][lowest_row(rows)])


def _nearest(frames: list[Frame], step: float) -> Frame:
    return min(frames, key=lambda frame: abs(frame.step - step))


def _at_peak(result: "ResultData") -> Chosen:
    if not len(result.history.rows.get("stress", ())):
        return Chosen(
            at_peak(result), "at the end", "this result has no rows, so its peak is not known; the end is drawn"
        )
    if not result.has_drive:
        return Chosen(at_peak(result), "at the end")
    return Chosen(at_peak(result), "at the peak")


def _at_lowest(result: "ResultData") -> Chosen:
    rows = result.history.rows
    stress = rows.get("stress", np.zeros(0))
    if not stress.min(initial=0.0) < 0.0:
        raise SceneError("step 'lowest': no stress below zero was recorded in this run")
    row = int(np.argmin(stress))
    frame = _nearest(result.history.frames, rows["step"][row])
    if frame.step == rows["step"][row]:
        return Chosen(frame, "at the lowest stress")
    return Chosen(
        frame,
        "nearest kept to the lowest stress",
        f"no frame was kept at the lowest stress, {stress[row] * 1e-6:.3g} MPa at step {rows['step'][row]:.0f}; the "
        f"nearest of {len(result.history.frames)} is drawn: step {frame.step} (a run keeps more with --set "
        "solver.frames=100)",
    )


def _measure(step: str | int | float, result: "ResultData") -> tuple[float, np.ndarray, float]:
    """Value asked for, the same of each frame, and the distance from it that is as good as there."""
    text, frames = str(step).strip(), result.history.frames
    if text.isdecimal():
        return float(text), np.array([frame.step for frame in frames], dtype=float), 0.0
    if (time := _quantity(text, "time")) is not None:
        if not result.in_real_time:
            raise SceneError(f"step '{text}': this run is not in real time, so it has no times; {_allowed(result)}")
        return time, np.array([frame.time for frame in frames]) - result.time_origin, 1e-3 * abs(time)
    at = step if isinstance(step, float) and math.isfinite(step) else _quantity(text, "length")
    if at is None:
        raise SceneError(f"step '{text}': {_allowed(result)}{did_you_mean(text, WORDS)}")
    if not result.has_drive:
        raise SceneError(
            f"step '{text}': nothing is driven in this run, so no frame has a displacement of the drive; "
            f"{_allowed(result)}"
        )
    return at, np.array([frame.displacement for frame in frames]), 1e-6 * max(abs(at), 1e-12)


def _quantity(text: str, kind: str) -> float | None:
    """A text as a quantity of a kind, in SI; None where it is none."""
    from masonry.quantity import convert

    try:
        return convert(text, kind, "step", "[-1e5, 1e5]")
    except ValueError:
        return None


def _allowed(result: "ResultData") -> str:
    """Values that may be asked for, in words."""
    choices = [*WORDS, "the number of a step"]
    choices += ["a displacement such as '0.05 mm'"] if result.has_drive else []
    choices += ["a time such as '1.2 s'"] if result.in_real_time else []
    return f"{', '.join(choices[:-1])}, or {choices[-1]}"


def without_noise(value: float, values: np.ndarray) -> float:
    """A value as it is written beside others; 0, never -0, where it is but their rounding."""
    return value if abs(value) > NOISE * float(np.abs(values).max(initial=0.0)) else 0.0
