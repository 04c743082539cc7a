"""A run with an own law in real processes: compiled once, never served stale, and in nobody's way where it has
gone; and its energy is the closed form.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.cli.test_cache import ROOT, RUN, Ran
from tests.laws.own_package import files_of_page, install

PULLED = ["confinement=0 MPa", "drive.direction=z", 'support.1.fix=["x", "y", "rotation"]']
SHORT = ["settle.steps=100", "drive.displacement=0.1 mm", "drive.steps=6000", "solver.rows=600"]
BILINEAR = ["law=bilinear", "contact.unit_unit.opening_at_knee=8 um", "contact.unit_unit.share_at_knee=0.3"]
OURS = ["law=linear"]
ENERGY = 'print(json.dumps([compiled, [result.summary["energy_j"]["fracture_mode_1"] / result.summary["section_m2"], '
MORE = 'result.summary["peak_stress_pa"], result.summary["dissipation_mismatch"]], tools, kept, told]))'


class Here:
    """A folder with the package of the page, and a cache of its own."""

    def __init__(self, root: Path) -> None:
        self.root, self.package = root, install(root / "package")

    def run(self, law: list[str] | None = None) -> Ran:
        """Pull the couplet apart in a process of its own: what was compiled, and fracture energy, peak, mismatch."""
        text = RUN[: RUN.index("print(json")] + ENERGY + MORE
        done = subprocess.run(
            [sys.executable, "-c", text, str(ROOT), *PULLED, *SHORT, *(law or BILINEAR)],
            env=os.environ | {"PYTHONPATH": f"{ROOT}:{self.package}", "MASONRY_CACHE": str(self.root / "cache")},
            cwd=self.root,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        return Ran(*json.loads(done.stdout))


@pytest.fixture(scope="module")
def used(tmp_path_factory) -> tuple[Here, Ran]:
    here = Here(tmp_path_factory.mktemp("own"))
    first = here.run()
    assert "_sweep" in first.compiled
    return here, first


def test_a_couplet_that_is_pulled_apart_spends_the_energy_of_its_law(used):
    fracture, peak, mismatch = used[1].numbers
    assert fracture == pytest.approx(5.8 + 0.5 * 0.58e6**2 / 150e9, rel=1e-9)
    assert peak == pytest.approx(0.58e6, rel=1e-3) and mismatch < 1e-3


def test_a_second_process_compiles_nothing(used):
    here, first = used
    again = here.run()
    assert again == Ran([], first.numbers, tools=False, kept=[], told=again.told)


@pytest.mark.slow
def test_our_laws_are_found_as_well_where_the_package_has_gone(used):
    here = used[0]
    assert "_sweep" in here.run(OURS).compiled
    kept = here.package.rename(here.root / "gone")
    again = here.run(OURS)
    kept.rename(here.package)
    assert again.compiled == []


def test_an_edit_of_the_law_is_compiled_and_changes_the_run(used):
    here, first = used
    text = re.sub(r"parameters\.G_I\b", "(0.8 * parameters.G_I)", files_of_page()["bilinear.py"])
    (here.package / "bilinear.py").write_text(text, encoding="utf-8")
    edited = here.run()
    assert "_sweep" in edited.compiled
    assert edited.numbers[0] == pytest.approx(first.numbers[0] - 0.2 * 5.8, rel=1e-9)
    assert np.isclose(edited.numbers[1], first.numbers[1])
