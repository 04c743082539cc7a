"""A refinement that is interrupted or killed, and gone on with: the same table."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from shutil import rmtree

import pytest
import tomli_w

from masonry.errors import SceneError
from masonry.scene import load
from masonry.sweeps.convergence.convergence import converge
from tests.convergence.samples import TIPPED

ENOUGH = 60.0
"""Times the scene: all runs are made, however long each of them takes."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return converge(load(TIPPED), tmp_path_factory.mktemp("whole") / "out", cost=ENOUGH, workers=0)


def table(folder):
    return (folder / "convergence.csv").read_bytes()


def test_what_is_interrupted_goes_on_to_the_same_table(whole, tmp_path):
    """After two runs, and again in the second round."""
    for stop in (2, len(whole.runs) - 1):

        def tell(line, stop=stop):
            if " OK " in line and len(list((tmp_path / "out" / "runs").glob("*/summary.json"))) == stop:
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            converge(load(TIPPED), tmp_path / "out", cost=ENOUGH, workers=0, tell=tell)
        assert not (tmp_path / "out" / "convergence.csv").exists()
    result = converge(load(TIPPED), tmp_path / "out", cost=ENOUGH, workers=0)
    assert table(result.folder) == table(whole.folder) and len(result.runs) == len(whole.runs)


def test_runs_that_are_lost_are_made_again_and_the_table_is_the_same(whole):
    before, keys = table(whole.folder), [row["key"] for _, row in whole.runs]
    rmtree(whole.folder / "runs" / keys[1])
    (whole.folder / "runs" / keys[2] / "summary.json").unlink()
    lines = []
    again = converge(load(TIPPED), whole.folder, cost=ENOUGH, workers=0, tell=lines.append, overwrite=True)
    assert table(again.folder) == before
    assert sum(" OK " in line for line in lines) == 2


@pytest.mark.skipif(os.name == "nt", reason="no such signal")
def test_a_command_that_is_killed_goes_on_to_the_same_table(whole, tmp_path):
    scene, out = tmp_path / "tipped.toml", tmp_path / "out"
    scene.write_text(tomli_w.dumps(TIPPED))
    words = [sys.executable, "-m", "masonry", "converge", str(scene), "--cost", f"{ENOUGH}", "--workers", "1"]
    command = subprocess.Popen([*words, "--out", str(out)], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    try:
        while command.poll() is None and len(list(out.glob("runs/*/summary.json"))) < 2:
            time.sleep(0.02)
    finally:
        command.send_signal(signal.SIGKILL)
        command.wait()
    assert not (out / "convergence.csv").exists()
    done = subprocess.run([*words, "--out", str(out)], capture_output=True, text=True, check=True)
    assert "are done already" in done.stderr and table(out) == table(whole.folder)


def test_runs_that_an_executor_does_make_the_same_table(whole, tmp_path):
    with ThreadPoolExecutor(1) as executor:
        result = converge(load(TIPPED), tmp_path / "out", cost=ENOUGH, workers=executor)
    assert table(result.folder) == table(whole.folder)
    with pytest.raises(SceneError, match="give a Dask client"):
        converge(load(TIPPED), tmp_path / "out", workers=3.5)
