"""Pictures are drawn by another process while a run goes on, and by the run itself where that fails."""

import os
import subprocess
import sys
from contextlib import closing

import pytest

from masonry.pictures.painter import Painter, painter
from masonry.results.data import PICTURES
from tests.results.sample import sample


def test_the_painter_draws_what_the_run_would_have_drawn(tmp_path):
    result, painted, drawn = sample(), tmp_path / "painted", tmp_path / "drawn"
    with closing(Painter()) as hired:
        result.save(painted, hired)
        assert hired.is_gone
    result.save(drawn)
    for name in PICTURES:
        assert (painted / name).read_bytes() == (drawn / name).read_bytes()
    assert not list(painted.glob(".*"))


def test_where_the_painter_fails_the_run_draws_its_pictures_itself(tmp_path):
    result = sample()
    with closing(Painter()) as hired:
        hired.begin(tmp_path / "nothing here")
        assert not hired.has_drawn()

    class Broken:
        def begin(self, folder):
            assert (folder / "history.h5").is_file(), "the numbers come first"

        def has_drawn(self):
            return False

    paths = result.save(tmp_path, Broken())
    assert all(path.is_file() for path in paths.values())


def test_a_painter_without_an_order_goes_at_once():
    hired = Painter()
    process = hired.process
    hired.close()
    assert hired.is_gone
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


def test_a_painter_whose_run_was_killed_goes_as_well():
    code = "import os, masonry.pictures.painter as p; hired = p.Painter(); print(hired.process, flush=True); os.kill(os.getpid(), 9)"
    killed = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, timeout=60)
    assert killed.returncode == -9 and killed.stdout.strip().isdecimal()  # its output ended: nobody holds it any more


def test_none_is_hired_where_all_is_loaded_already():
    assert "numpy" in sys.modules
    with painter() as hired:
        assert hired is None


def test_the_command_hires_a_painter_which_it_can_only_before_anything_heavy_is_loaded(tmp_path):
    code = (
        "import sys; from masonry import painter; from masonry.cli.main import main;"
        "begin = painter.Painter.begin;"
        "painter.Painter.begin = lambda self, folder: (print('painted'), begin(self, folder));"
        "main(['run', 'couplet', '--quiet', '--out', 'r', '--set', 'drive.displacement=0.01 mm'])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stdout.split() == ["painted"]
