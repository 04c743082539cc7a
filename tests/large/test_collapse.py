"""A dry arch that is tilted until it falls: at which tilt, which voussoir, and what is said of it."""

import re
from functools import cache
from math import cos, radians, sin, sqrt, tan

import pytest

from masonry import scene
from masonry.judgement.judgement import judge
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.laboratory.text import summary_text
from tests.large.made import G, dry, leaning, slab
from tests.scenes import box, tables

SETTINGS = {"settle.steps": 8000, "gravity.tilt.duration": "4 s", "solver.duration": "4.5 s", "solver.until": None}
SETTINGS |= {"solver.rows": 600}


@cache
def tilted():
    return laboratory.run(scene.load("arch-tilted", SETTINGS))


def test_it_falls_at_the_tilt_of_its_mechanism():
    fallen = tilted().summary["collapse"]
    assert fallen is not None
    assert tan(fallen["began"]["tilt_rad"]) == pytest.approx(0.37361, rel=0.05), "faster than the packaged scene tilts"
    assert fallen["began"]["tilt_rad"] < fallen["tilt_rad"]
    assert fallen["began"]["time_s"] < fallen["time_s"]
    assert fallen["energy_j"]["kinetic"] > 0.0


def test_what_is_said_of_it_names_the_fall_and_does_not_call_a_fall_a_defect():
    summary = tilted().summary
    assert summary["in_real_time"]
    text = " ".join(summary_text(summary).split())
    assert f"collapse block {summary['collapse']['block']} (" in text
    assert "is the first to fall, after" in text and "the fall began after" in text and "with gravity turned by" in text
    sentence = trust(summary)
    assert "quasi-static" not in sentence and "come to rest" not in sentence and "still moves" not in sentence


def test_a_run_in_real_time_with_a_clean_ledger_is_trusted_and_an_open_one_is_not():
    good = {**tilted().summary, "energy_imbalance": 1e-14, "dissipation_mismatch": 1e-5, "overlap_max": 1e-4}
    assert judge(good).verdict == "sound"
    for key, bad, words in (
        ("energy_imbalance", 1e-6, "balance is open"),
        ("dissipation_mismatch", 0.1013, "disagree on the dissipated energy by 10.1 % (should be under 1 %)"),
        ("overlap_max", 0.1, "raise the normal stiffness"),
        ("energy_j", {**tilted().summary["energy_j"], "damping": 1e3}, "set solver.damping = 0"),
        ("energy_j", {**tilted().summary["energy_j"], "friction": None}, "no number of this energy: friction"),
    ):
        (doubt,) = judge({**good, key: bad}).doubts
        assert words in doubt.line


def test_a_block_that_slides_off_the_floor_is_told_and_falls_on():
    edge, half = 0.25, 0.05
    floor = '[floor]\nsize = ["0.5 m", "0.5 m"]\nthickness = "50 mm"\n'
    touch = 'normal_stiffness = "10 GPa/m"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = {}'
    met = {mu: floor + tables("contact", {"floor_units": touch.format(mu)}) for mu in (0.2, 1.0)}
    block = box("block", (-half, -half, 0.0), (2.0 * half, 2.0 * half, half), "units", 0)
    result = laboratory.run(dry([block], 0.2, leaning(40.0), 0.5, supports=(), more=met[0.2]))
    (remark,) = [words for words in result.summary["warnings"] if "left the floor" in words]
    assert remark.partition(";")[0] in trust(result.summary)
    match = re.search(r"block 0 had left the floor after ([\d.]+) s: what leaves it falls on", remark)
    assert match is not None
    pace = G * (sin(radians(40.0)) - 0.2 * cos(radians(40.0)))
    at_edge = sqrt(2.0 * edge / pace)  # its middle is above the edge; then it falls by half of it and the floor
    assert at_edge < float(match[1]) < at_edge + sqrt(2.0 * (0.5 * half + 0.05) / (G * cos(radians(40.0)))) + 0.05
    assert result.summary["energy_imbalance"] < 1e-12

    stays = laboratory.run(dry([block], 1.0, leaning(40.0), 0.5, supports=(), more=met[1.0]))
    assert not any("left the floor" in words for words in stays.summary["warnings"])


@pytest.mark.parametrize("angle", [0.0, 45.0])
def test_a_plate_has_fallen_by_half_its_own_thickness_however_it_lies(angle):
    thickness = 0.02
    plate = box("plate", (-0.1, -0.1, 1.0), (0.2, 0.2, thickness), "units", 1)
    turned = f'turned = {{about = "y", angle = "{angle} deg"}}'
    fallen = laboratory.run(dry([slab(0.5), plate], duration=0.15, turned=turned)).summary["collapse"]
    assert fallen["time_s"] == pytest.approx(sqrt(thickness / G), abs=0.15 / 200), "a row is taken so often"


def test_what_stands_on_a_plate_that_a_drive_lets_down_has_not_fallen():
    lowered = '[drive]\non = "slab"\ndirection = "-z"\ndisplacement = "0.3 m"\nrate = "0.5 m/s"\n'
    held = ('on = "slab"\nfix = ["x", "y", "rotation"]',)
    cube = box("cube", (-0.05, -0.05, 0.0), (0.1, 0.1, 0.1), "units", 1)
    result = laboratory.run(dry([slab(1.0), cube], duration=0.8, supports=held, more=lowered))
    assert result.history.rows["displacement"][-1] == pytest.approx(0.3)
    assert result.summary["collapse"] is None
