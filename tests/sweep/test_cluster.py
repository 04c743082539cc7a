"""On a Dask cluster with two workers the rows are those of this machine's own processes."""

import os
import sys
from types import SimpleNamespace

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.sweeps import engine
from masonry.sweeps.cluster import work_on
from tests.sweep.samples import dying, jobs, marks, text, untimed

FOUR = ("0.1 MPa", "0.2 MPa", "0.3 MPa", "0.4 MPa")


@pytest.fixture(scope="module")
def cluster():
    """A real scheduler on this machine, and two workers: processes of their own."""
    from dask.distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as running:
        yield running


def test_a_cluster_gives_the_rows_that_this_machine_gives(cluster, tmp_path):
    lines = []
    there = engine.run(jobs(*FOUR), tmp_path / "there", tell=lines.append, executor=cluster.scheduler_address)
    here = engine.run(jobs(*FOUR), tmp_path / "here", 1)
    assert untimed(there) == untimed(here) and [row["status"] for row in there] == ["OK"] * 4
    assert len(marks(tmp_path / "there")) == 4 and "left" in lines[0]


def test_a_client_of_ones_own_does_the_runs_and_stays_open(cluster, tmp_path):
    from dask.distributed import Client

    with Client(cluster.scheduler_address, set_as_default=False) as client:
        rows = engine.run(jobs(*FOUR[:2]), tmp_path / "there", executor=client)
        assert [row["status"] for row in rows] == ["OK"] * 2 and client.status == "running"


def test_both_workers_of_the_cluster_compute(cluster):
    ends = dict(work_on(cluster.scheduler_address, slowly, range(8)))
    assert len(set(ends.values())) == 2 and os.getpid() not in ends.values()


def slowly(task):
    import time

    time.sleep(0.2)
    return os.getpid()


def test_a_run_that_kills_its_workers_is_a_row_with_its_reason(cluster, tmp_path, monkeypatch):
    monkeypatch.setattr(engine, "compute", dying)
    rows = engine.run(jobs(*FOUR[:2]), tmp_path, executor=cluster.scheduler_address)
    assert [row["status"] for row in rows] == ["OK", "ERROR"]
    assert "died" in rows[1]["reason"] or "worker" in rows[1]["reason"]


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense", "http://127.0.0.1:9", "tcp://x:y"])
def test_a_scheduler_that_does_not_answer_is_said_in_words(tmp_path, monkeypatch, address):
    monkeypatch.setattr("masonry.sweeps.cluster.PATIENCE", 0.5)
    with pytest.raises(SceneError, match=f"no Dask scheduler answers at '{address}'"):
        engine.run(jobs("0.1 MPa"), tmp_path, executor=address)


def test_without_dask_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "dask.distributed", SimpleNamespace())
    with pytest.raises(SceneError, match=r"pip install '\.\[cluster\]'"):
        engine.run(jobs("0.1 MPa"), tmp_path, executor="tcp://127.0.0.1:9")


def test_nothing_is_written_for_a_sweep_whose_scheduler_does_not_answer(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("masonry.sweeps.cluster.PATIENCE", 0.5)
    (tmp_path / "sweep.toml").write_text(text('[grid]\nconfinement = ["0.1 MPa"]\n'), encoding="utf-8")
    assert main(["sweep", "sweep.toml", "--scheduler", "tcp://127.0.0.1:9"]) == 2
    assert "no Dask scheduler answers" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.toml"]
