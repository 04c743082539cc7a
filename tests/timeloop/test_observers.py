"""Observers see the rows that are kept, and no others; what they remember goes into a file and comes back."""

import numpy as np

from masonry.assembly.assemble import assemble
from masonry.rows.columns import UNITS
from masonry.rows.history import History
from masonry.runtime.state_file import read, write
from masonry.scene import load
from masonry.timeloop import timeloop
from masonry.timeloop.loop import Loop
from masonry.timeloop.run_outcome import Outcome

FAST = {"drive.accuracy": "5 %", "settle.steps": 400}


def loop_of(built) -> Loop:
    loading = built.plan.loading(built.model, built.recording.rows)
    return Loop(built.model, loading, built.plan.settle, built.recording, 1, Outcome(History()))


def test_a_row_that_ends_the_run_is_in_no_column():
    built = assemble(load("couplet", {**FAST, "drive.displacement": "20 mm", "solver.slip_limit": "5 %"}))
    outcome = timeloop.run(built.model, built.plan, built.recording)
    assert "solver.slip_limit" in outcome.stopped
    columns = {**outcome.history.rows, **outcome.observed}
    assert {*UNITS, "slip", "overlap", "widest", "rotation"} <= columns.keys()
    assert len({len(values) for values in columns.values()}) == 1
    assert np.all(np.diff(outcome.observed["slip"]) >= 0.0) and 0.04 < outcome.observed["slip"][-1] <= 0.05


def test_what_observers_remember_comes_back_from_a_file_by_their_names(tmp_path):
    built = assemble(load("couplet", FAST))
    one, other = loop_of(built), loop_of(built)
    for _ in range(4):
        chunk = one.loading.next()
        assert chunk is not None
        before, _, _ = one.take_steps(one.done, chunk)
        one.done += chunk.steps
        one.take_row(one.done, before)
    write(tmp_path / "state.npz", one.state())
    other.restore(read(tmp_path / "state.npz"))
    assert one.rows == other.rows and one.observed == other.observed and len(other.rows["step"]) == 4
    for name, observer in one.observers.items():
        write(tmp_path / f"{name}-1.npz", observer.state())
        write(tmp_path / f"{name}-2.npz", other.observers[name].state())
        assert (tmp_path / f"{name}-1.npz").read_bytes() == (tmp_path / f"{name}-2.npz").read_bytes(), name
    assert one.observers["law_area"].state()["compression"].max() > 0.0
