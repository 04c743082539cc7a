"""Progress is a bar on a terminal and a few plain lines in a file."""

import io
import re
import threading
import time
from math import inf

import pytest

from masonry.assembly.assemble import assemble
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.laboratory.text import accuracy_text, summary_text
from masonry.results.summary import Summary
from masonry.runtime.progress import Effort, Progress, TimeLeft, duration
from masonry.scene import load
from masonry.timeloop import compiling
from tests.results.sample import SUMMARY


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


class Terminal(io.StringIO):
    def isatty(self):
        return True


def run(seconds_per_step, steps=1000, chunk=10):
    clock, stream = Clock(), io.StringIO()
    with Progress(steps, "wallette-mode-1", stream, clock) as progress:
        clock.now += 5  # compiling
        for step in range(chunk, steps + 1, chunk):
            clock.now += chunk * seconds_per_step
            progress.update(step, "stress 0.12 MPa")
    return stream.getvalue().splitlines()


def test_a_short_run_in_a_pipe_says_a_line_every_ten_percent():
    lines = run(0.01)
    assert len(lines) == 10
    assert lines[3] == "wallette-mode-1  40 %  6 s left  stress 0.12 MPa"
    assert lines[-1] == "wallette-mode-1  100 %  stress 0.12 MPa"


def test_a_long_run_in_a_pipe_says_a_line_every_ten_seconds():
    lines = run(0.25)
    assert len(lines) == 26
    assert "3 min 05 s left" in lines[6]


def test_nothing_is_said_of_the_time_left_before_there_is_evidence():
    assert not any("left" in line for line in run(0.001)), "a second is soon over"
    early = [line for line in run(2.0) if int(re.search(r"(\d+) %", line)[1]) < 5]
    assert len(early) == 4 and not any("left" in line for line in early)


def words_of(paces, left=lambda done: (1.0 - done, 1.0 - done)):
    """Words on the time left of a work in a hundred parts, which take so many seconds each."""
    now, watch, words = 0.0, TimeLeft(), []
    for part, pace in enumerate(paces, 1):
        now += pace
        effort = Effort(part / 100, *left(part / 100))
        watch.look(effort, now)
        words.append(watch.words(effort, now))
    return words


def test_a_work_that_slows_down_is_told_by_all_of_it_and_by_its_last_part():
    words = words_of([1.0] * 50 + [10.0] * 50)
    assert words[3] == "" and words[49] == "50 s left" and words[99] == ""
    assert words[79] == "1 min 28 s to 3 min 20 s left", "as fast as on average, and as fast as lately"


def test_a_work_that_may_end_by_itself_is_told_by_bounds():
    words = words_of([1.0] * 100, lambda done: (max(0.6 - done, 0.0), 1.0 - done))
    assert words[19] == "40 s to 1 min 20 s left" or words[19] == "57 s left"
    assert words[49] == "10 s to 50 s left" and words[69] == "at most 30 s left"


def test_where_nobody_knows_how_much_is_left_nothing_is_said_and_the_pace_does_not_count():
    words = words_of([100.0] * 50 + [1.0] * 50, lambda done: (1.0 - done, inf if done <= 0.5 else 1.0 - done))
    assert not any(words[:50]) and words[79] == "20 s left"


def test_a_run_tells_how_much_work_is_left():
    progress = Progress(stream=io.StringIO())
    laboratory.run(load("couplet", {"drive.accuracy": 0.05}), progress=progress)
    assert progress.effort.done == pytest.approx(1.0) and progress.effort.maximum == pytest.approx(0.0)


def test_a_run_of_unknown_length_counts_its_steps_and_may_learn_its_length():
    clock, stream = Clock(), io.StringIO()
    progress = Progress(label="x", stream=stream, clock=clock)
    progress.update(0)
    clock.now += 11
    progress.update(50)
    progress.total_steps = 100
    progress.update(100)
    assert stream.getvalue().splitlines() == ["x  50 steps", "x  100 %"]


def test_what_comes_before_the_first_part_is_said_once_and_then_now_and_then():
    clock, stream = Clock(), io.StringIO()
    progress = Progress(label="x", stream=stream, clock=clock)
    progress.update(0, "compiling the step")
    for step in range(1, 101):
        clock.now += 0.15
        progress.update(0, f"step {step}, stress 0.0 MPa")
    assert stream.getvalue().splitlines() == [
        "x  compiling the step",
        "x  step 1, stress 0.0 MPa",
        "x  step 68, stress 0.0 MPa",
    ]


def test_a_terminal_gets_a_bar_with_percent_speed_and_note():
    clock, stream = Clock(), Terminal()
    with Progress(1000, "couplet [red]", stream, clock) as progress:
        for step in range(0, 1001, 100):
            clock.now += 1
            progress.update(step, "stress [MPa]")
    said = stream.getvalue()
    for words in ("couplet [red]", "100%", "stress [MPa]"):
        assert words in said


def test_a_reader_that_goes_away_does_not_end_the_run():
    class Gone(io.StringIO):
        def write(self, text):
            raise BrokenPipeError

    Progress(10, "x", Gone()).update(10)


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.1234, "0.12 s"), (12.3, "12 s"), (59.6, "1 min 00 s"), (185, "3 min 05 s"), (7500, "2 h 05 min")],
)
def test_durations_read_as_one_says_them(seconds, words):
    assert duration(seconds) == words


def test_trust_follows_from_the_numbers():
    assert trust(SUMMARY).startswith("sound: quasi-static")
    assert "drive and support differ by 0.3" in trust(SUMMARY | {"reaction_mismatch_max": 0.3})
    assert "load more slowly" in summary_text(Summary.read(SUMMARY | {"kinetic_over_internal_max": 0.5}))
    assert "open by 0.001" in trust(SUMMARY | {"energy_imbalance": -1e-3})
    assert "not known" in trust(SUMMARY | {"energy_imbalance": None})
    assert "interrupted" in trust(SUMMARY | {"interrupted": True})


def test_a_summary_with_gaps_can_still_be_printed():
    assert summary_text(Summary()).count("not known") >= 8


CONTROL = Summary(
    control={"accuracy": 0.01, "mean_lag": 0.0, "largest_lag": 0.0},
    energy_j={"fracture_mode_1": 0.0, "fracture_mode_2": 0.0},
    damping_over_external=-4.9e-6,
    kinetic_over_internal_max=1.115e-198,
    joints_opened_or_slid=0,
)


def test_a_run_without_damage_says_so_and_rounding_reads_as_0():
    assert accuracy_text(CONTROL) == "1 % asked for; no contact was damaged; damping took 0 % of the work"
    assert "kinetic energy        at most 0 % of" in summary_text(CONTROL)
    damaged = CONTROL | {"energy_j": {"fracture_mode_1": 0.0, "fracture_mode_2": 1e-3}, "damping_over_external": 2e-3}
    assert "after the first damage the specimen lagged behind the drive" in accuracy_text(damaged)
    assert "damping took 0.2 % of the work" in accuracy_text(damaged)
    assert "damping gave 0.38 % of the work, by pulling" in accuracy_text(damaged | {"damping_over_external": -3.8e-3})
    assert "damping gave 3 %" in accuracy_text(CONTROL | {"damping_over_external": -0.03})


def test_while_something_is_compiled_the_seconds_are_told_and_nothing_after_it(monkeypatch):
    monkeypatch.setattr("masonry.runtime.progress.TICK_SECONDS", 0.01)
    stream = io.StringIO()
    seen = threading.Event()

    class Ticking(Clock):
        def __call__(self):
            self.now += 4.0
            if self.now > 140.0:
                seen.set()
            return self.now

    with Progress(label="x", stream=stream, clock=Ticking()) as progress:
        progress(0, 0, "compiling")
        with progress.waiting("compiling", 20.0):
            assert seen.wait(10.0)
        threads = threading.active_count()
        said = stream.getvalue().splitlines()
    assert said[0] == "x  compiling" and re.fullmatch(r"x  compiling: \d+ s of about 20 s", said[1])
    assert threading.active_count() == threads and stream.getvalue().splitlines() == said


def test_what_is_compiled_says_how_long_it_took_last_time(tmp_path, monkeypatch):
    monkeypatch.setenv("MASONRY_CACHE", str(tmp_path))
    monkeypatch.setattr(compiling, "is_compiled", lambda model, threads: False)
    sleeps = iter([0.2, 0.7, 0.2, 0.0])
    monkeypatch.setattr(compiling, "compile_for", lambda model, threads: time.sleep(next(sleeps)))
    model = assemble(load("couplet")).model
    notes = []
    for _ in range(4):
        compiling.prepare(model, 1, lambda step, steps, note: notes.append(note))
    assert notes[0].endswith("rigid blocks, law exponential (once for all such scenes)")
    assert notes[1].endswith("rigid blocks, law exponential (once for all such scenes, 0.2 s last time)")
    assert notes[2].endswith("(once for all such scenes, 0.7 s last time)")
    assert notes[3].endswith("(once for all such scenes, 0.2 s last time and 0.7 s at most)")
