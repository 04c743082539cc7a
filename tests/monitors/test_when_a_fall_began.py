"""When a fall began: steady motion is none; where too much changes while it gains speed, it is not known."""

import numpy as np
import pytest

import masonry
from masonry.laboratory.summary.beginning_of_fall import beginning
from masonry.laboratory.summary.movements import LATE, not_known
from masonry.laboratory.text import collapse_text
from masonry.results.summary import FirstFall, Moment
from masonry.scene import load as load_scene

SPREAD, PACE, GROWS = 34e-3, 2e-3, 4.0
"""Drive (m) at which the balance is lost, speed of the packaged arch (m/s), rate (1/s) at which it then gains speed."""


def rows_of(faster: float, noise: float = 0.0, rows: int = 1000, falls: bool = True) -> dict[str, np.ndarray]:
    """What follows a drive at its speed, and is pushed more and more once the balance is lost: x'' = p^2 (x + v t)."""
    speed, lost = faster * PACE, SPREAD / (faster * PACE)
    ends = lost + np.arccosh(1.0 + 1.0 / speed) / GROWS
    time = np.linspace(0.0, ends, rows)
    alone = speed * (np.cosh(GROWS * np.maximum(time - lost, 0.0)) - 1.0) if falls else np.zeros(rows)
    shakes = 1.0 + noise * np.sin(1e3 * time)
    return {"time": time, "displacement": speed * time, "kinetic": 0.5 * (speed**2 * shakes + alone**2)}


@pytest.mark.parametrize("noise", [0.0, 0.05])
@pytest.mark.parametrize("faster", [1 / 3, 1.0, 2.0, 3.0, 5.0, 10.0])
def test_it_is_right_or_not_known_from_a_third_of_the_packaged_speed_to_ten_times(faster, noise):
    rows = rows_of(faster, noise)
    last, time = beginning(rows, len(rows["time"]) - 1)
    place, set_out = rows["displacement"][last], np.interp(time, rows["time"], rows["displacement"])
    known = abs(place - set_out) <= LATE * place
    assert known or faster > 2.0, "what is slow is known"
    assert not known or place == pytest.approx(SPREAD, rel=1.5 * LATE)
    assert place > 0.9 * SPREAD, "not where the drive set out"
    assert set_out == pytest.approx(SPREAD, rel=0.15)


def test_what_goes_down_as_steadily_as_the_drive_moves_has_not_begun_to_fall():
    rows = rows_of(3.0, falls=False)
    assert beginning(rows, 700)[0] == 700


def test_slow_motion_is_told_by_the_energy_of_the_fall_as_where_nothing_drives():
    rows = rows_of(0.01)
    last, _ = beginning(rows, 999)
    assert last == np.flatnonzero(rows["kinetic"] < 1e-4 * rows["kinetic"][-1])[-1]


def test_a_fall_of_which_it_is_not_known_when_it_began_is_told_so():
    unknown = "the drive went from 31.87 to 35.88 mm while it gained speed: drive or load more slowly"
    fallen = FirstFall(block=3, sets=["keystone"], at_m=[0.0, 0.15, 0.98], time_s=1.0, began_unknown=unknown)
    words = collapse_text(fallen)
    assert words.endswith(f"after 1 s; when the fall began is not known: {unknown}")


def test_what_changed_while_it_gathered_way_is_named_from_four_per_cent_on():
    def words(share: float, **more) -> str:
        began = Moment(displacement_m=-0.03, tilt_rad=0.3, loads={"traction.0": 0.5})
        return not_known(began | {"displacement_m": -0.03 * (1.0 - share)} | more, began)

    assert words(0.039) == ""
    assert words(0.041) == "the drive went from -28.77 to -30 mm while it gained speed: drive or load more slowly"
    assert "the tilt went from 16.04 to 17.19 deg while" in words(0.0, tilt_rad=0.28)
    assert "the traction.0 went from 0.4 to 0.5 of its value while" in words(0.0, loads={"traction.0": 0.4})


@pytest.mark.slow
@pytest.mark.parametrize("seconds", [60.0, 20.0, 8.0, 2.0])
def test_supports_that_move_faster_than_packaged_are_no_fall(seconds):
    """An arch of t/R = 0.15 loses its balance at 0.117 R in all."""
    knobs = {"drive.history": [["0 s", "0 mm"], [f"{seconds} s", "-130 mm"]], "solver.duration": f"{seconds + 1.0} s"}
    knobs |= {"specimen.voussoirs": 16, "specimen.thickness": "150 mm", "solver.until": None}
    fallen = masonry.run(load_scene("arch-spreading", knobs)).summary["collapse"]
    if fallen["began"] is None:
        assert seconds < 10.0 and "the drive went from" in fallen["began_unknown"]
    else:
        assert abs(fallen["began"]["displacement_m"]) == pytest.approx(0.117, rel=0.03)
