"""No command runs what lies in the current folder, such as a `pickle.py` beside a scene, in whatever process."""

import contextlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from masonry.errors import SceneError
from masonry.movies.movie_file import _ffmpeg

ROOT = Path(__file__).resolve().parents[2]
LOADED = (
    *("masonry", "geometry", "verification", "sitecustomize", "usercustomize", "numpy", "scipy", "numba", "llvmlite"),
    *("h5py", "gmsh", "matplotlib", "filelock", "threadpoolctl", "pydantic", "rich", "tomli_w", "trimesh", "dask"),
    *("json", "pickle", "typing", "subprocess", "multiprocessing", "threading", "signal", "socket", "random", "struct"),
    *("tempfile", "hashlib", "tomllib", "argparse", "copyreg", "selectors", "runpy", "re", "enum", "functools"),
)
"""Names of modules that some process of a command loads."""
HOSTILE = "import os\nwith open({mark!r}, 'a') as file: file.write(__name__ + '\\n')\nraise SystemExit('hostile')\n"
SCRIPT = "import sys\nsys.path.append({root!r})\nfrom masonry.cli.main import main\nsys.exit(main())\n"
"""What pip makes of the entry point, as a script in a folder of its own."""
BOX = """
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""
SWEEP = """
scene = "couplet"
settings = {"settle.steps" = 100, "drive.steps" = 2000, "solver.rows" = 40}
grid = {"confinement" = ["0.1 MPa", "0.2 MPa"]}
"""
SHORT = ["--set", "settle.steps=100", "--set", "drive.steps=2000", "--set", "solver.rows=40"]
COMMANDS = [
    ["run", "couplet", *SHORT, "--out", "out", "--quiet"],
    ["sweep", "sweep.toml", "--quiet", "--workers", "2"],
    ["sensitivity", "couplet", *SHORT, "--only", "damping", "--quick", "--workers", "2"],
    ["import", "box.obj", "--unit", "m", "--out", "box.toml"],
    ["verify", "shear-exponential", "--workers", "2"],
    ["export", "couplet", "--to", "couplet.step"],
    ["doctor", "--quick"],
    ["movie", "out"],
]
"""Those that start other processes, the first of them to compile, and some that load libraries of others."""


@pytest.fixture
def hostile(tmp_path) -> Path:
    """A folder with a scene's data, and with modules and packages that say so when they are run."""
    folder = tmp_path / "work"
    folder.mkdir()
    (folder / "box.obj").write_text(BOX)
    (folder / "sweep.toml").write_text(SWEEP)
    text = HOSTILE.format(mark=str(tmp_path / "ran"))
    for name in LOADED:
        (folder / f"{name}.py").write_text(text)
        (folder / name).mkdir()
        (folder / name / "__init__.py").write_text(text)
    return folder


def ran(folder: Path) -> str:
    """The modules of the folder that were run."""
    mark = folder.parent / "ran"
    return mark.read_text() if mark.exists() else ""


def call(folder: Path, *command: str) -> subprocess.CompletedProcess:
    """A command there, with a cache of its own and two processes that compile."""
    surroundings = os.environ | {"MASONRY_CACHE": str(folder.parent), "MASONRY_COMPILERS": "2"}
    surroundings.pop("PYTHONSAFEPATH", None)
    return subprocess.run([sys.executable, *command], cwd=folder, env=surroundings, capture_output=True, text=True)


def test_what_lies_beside_a_scene_is_run_by_no_process_of_a_command(hostile):
    (script := hostile.parent / "bin" / "masonry").parent.mkdir()
    script.write_text(SCRIPT.format(root=str(ROOT)))
    for words in COMMANDS:
        done = call(hostile, str(script), *words)
        assert (done.returncode, ran(hostile)) == (0, ""), f"{words}: {done.stderr}"
    assert (hostile / "out" / "summary.json").is_file() and (hostile / "couplet.step").is_file()


def test_python_m_masonry_runs_nothing_of_the_current_folder_but_a_program_of_this_name(hostile):
    for name in ("masonry", "geometry"):
        (hostile / f"{name}.py").unlink()
        (hostile / name / "__init__.py").unlink()
        (hostile / name).rmdir()
    done = call(hostile, "-m", "masonry", "import", "box.obj", "--unit", "m", "--out", "box.toml")
    assert (done.returncode, ran(hostile)) == (0, ""), done.stderr


def test_an_ffmpeg_of_the_current_folder_is_not_called_though_path_names_that(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (program := tmp_path / "ffmpeg").write_text("#!/bin/sh")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", os.pathsep.join([".", "", "bin"]))
    assert shutil.which("ffmpeg") is not None
    with contextlib.suppress(SceneError):  # there is none on this machine
        assert os.path.isabs(_ffmpeg()) and Path(_ffmpeg()) != program
