"""A limit analysis takes seconds; one that takes long says so beforehand, shows how far it is, and ends on Ctrl-C."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np
import pytest

from masonry.limit_analysis.expected import LONG, seconds_expected, size_words
from masonry.runtime.interrupts import interruptible_wait
from masonry.statics.solve import Method, largest_factor, standing
from tests.limit.blocks import CONES, PLANE, PYRAMIDS, dry, wall

RUBBLE = ("limit", "wall-three-leaf", "--set", "specimen.core.total=800")


def test_each_iteration_is_told_with_a_gap_that_falls():
    said: list[tuple[int, str]] = []
    tells = replace(CONES, tell=lambda iterations, note: said.append((iterations, note)))
    bodies, contacts = dry(wall(6, halves_below=True), [0], 0.65)
    assert largest_factor(bodies, contacts, tells).factor == largest_factor(bodies, contacts, CONES).factor
    assert [iterations for iterations, _ in said] == list(range(1, len(said) + 1))
    gaps = [float(note.split()[1].rstrip(",")) for _, note in said]
    assert gaps[-1] < 1e-9 < 1e-3 < max(gaps)


def test_what_it_takes_is_said_beforehand_where_it_takes_long():
    bodies, contacts = dry(wall(6, halves_below=True), [0], 0.65)
    assert size_words(contacts, CONES, True) == ""
    many = contacts.select(list(range(contacts.count)) * 200)
    assert seconds_expected(many.count, 0) > LONG
    words = size_words(many, CONES, True)
    assert f"{many.count} contact points" in words and "GB" in words and "fewer blocks" in words
    assert "without --linear" in size_words(many, PYRAMIDS, True)
    assert "a hundred" in size_words(many, CONES, False)


@pytest.mark.parametrize("sides", [0, 16])
def test_a_plane_method_and_one_in_space_tell_alike(sides):
    assert Method(sides=sides) == Method(sides=sides, tell=lambda iterations, note: None)


def test_a_call_that_is_waited_for_hands_on_what_it_returns_and_raises():
    assert interruptible_wait(lambda: 7) == 7
    with pytest.raises(ZeroDivisionError):
        interruptible_wait(lambda: 1 / 0)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("words", [(), ("--linear", "16")])
def test_ctrl_c_ends_a_long_one_within_seconds(words, tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "masonry", *RUBBLE, *words, "--out", str(tmp_path / "out")],
        stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, cwd=Path.cwd(), env=dict(os.environ),
    )  # fmt: skip
    said = ""
    while "limit  " not in said:  # the sizes, or how far it is: it is at work
        said += process.stderr.readline()
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    begun = time.monotonic()
    said += process.communicate(timeout=60)[1]
    assert time.monotonic() - begun < 5.0
    assert process.returncode == 130 and said.rstrip().endswith("masonry: interrupted before there were results")
    assert "Traceback" not in said and not (tmp_path / "out").exists()


def seconds_of_a_wall(courses: int, units: int) -> tuple[float, int]:
    """Until a wall 0.1 m thick is known to stand, and to fall over at thickness over height."""
    bodies, contacts = dry(wall(courses, halves_below=True, units=units), [0], 0.65, live=(0.3, 1.0, 0.0))
    begun = process_time()
    assert standing(bodies, contacts, CONES).factor == pytest.approx(1.0, abs=1e-7)
    solution = largest_factor(bodies, contacts, CONES)
    seconds = process_time() - begun
    assert solution.factor == pytest.approx(0.1 / (0.175 * courses), rel=1e-6)
    assert solution.gap < 1e-6
    return seconds, len(np.unique(contacts.patch))


def test_600_joints_in_space_take_less_than_3_seconds():
    seconds, joints = seconds_of_a_wall(16, 13)
    assert joints > 600 and seconds < 3.0


@pytest.mark.slow
def test_5000_joints_in_space_take_less_than_a_minute():
    seconds, joints = seconds_of_a_wall(40, 44)
    assert joints > 5000 and seconds < 60.0


def test_a_plane_wall_of_600_joints_takes_less_than_3_seconds_and_is_the_same_in_space():
    bodies, contacts = dry(wall(16, halves_below=True, units=13), [0], 0.65)
    begun = process_time()
    flat = largest_factor(bodies, contacts, PLANE).factor
    assert process_time() - begun < 3.0
    assert largest_factor(bodies, contacts, CONES).factor == pytest.approx(flat, rel=1e-6)
