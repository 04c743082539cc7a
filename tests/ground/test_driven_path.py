"""A drive along a table in real time: a spline with continuous acceleration, at rest at both ends."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.assembly.driven_path import path_in_time
from masonry.laboratory.summary.moved_drive import moved_drive
from masonry.scene import load

TIME = 0.05 * np.arange(81)
PLACE = 5e-3 * np.sin(4.0 * np.pi * TIME) * np.sin(np.pi * TIME / 4.0) ** 2
TABLE = [[f"{t!r} s", f"{x!r} m"] for t, x in zip(TIME.tolist(), PLACE.tolist(), strict=True)]


def test_it_passes_through_its_rows_and_accelerates_as_they_do():
    scene = load("block-rocking", {"drive": {"on": "block", "direction": "x", "history": TABLE}})
    path = path_in_time(scene)
    assert path.at(TIME) == pytest.approx(PLACE, abs=1e-15)
    fine = np.linspace(0.0, 4.0, 40_001)
    second = np.gradient(np.gradient(path.at(fine), fine), fine)
    exact = np.gradient(np.gradient(5e-3 * np.sin(4 * np.pi * fine) * np.sin(np.pi * fine / 4) ** 2, fine), fine)
    assert np.abs(second).max() == pytest.approx(np.abs(exact).max(), rel=0.05)
    assert np.abs(np.diff(second)).max() < 0.01 * np.abs(exact).max()


def test_scaled_masses_turn_exactly_at_the_rows():
    drive = {"on": "top", "direction": "-z", "history": [["0 s", "0 mm"], ["1 s", "0.1 mm"], ["2 s", "0 mm"]]}
    path = path_in_time(load("couplet", {"drive": drive}))
    assert path.at(np.linspace(0.0, 2.0, 1001)).max() == pytest.approx(1e-4, rel=1e-12)


def test_the_largest_velocity_and_acceleration_of_a_drive_are_told():
    drive = {"on": "block", "direction": "x", "history": TABLE}
    assembly = assemble(load("block-rocking", {"drive": drive, "solver.duration": "5 s"}))
    moved = moved_drive(assembly)
    assert moved.peak_velocity_m_s == pytest.approx(np.abs(np.gradient(PLACE, TIME)).max(), rel=0.1)
    assert moved.peak_acceleration_m_s2 == pytest.approx(5e-3 * (4 * np.pi) ** 2, rel=0.06)
    assert moved_drive(assemble(load("couplet"))) is None
