"""What is printed of a motion in real time: nothing of what it has not, and no riddles."""

import re
from functools import cache

import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
from masonry.laboratory.shaking_text import shaking_rows
from masonry.laboratory.text import check_text, collapse_text, summary_text
from masonry.results.summary import FirstFall, GaugeSwing, LargestForce, Moment, Shaking
from masonry.timeloop.compiling import compiling_text
from tests.large.made import dry, slab
from tests.scenes import box

BEGAN = Moment(step=1, time_s=0.5)
FALLEN = FirstFall(block=3, sets=["keystone"], at_m=[-2.776e-17, 0.15, 0.98], time_s=1.0, began=BEGAN)


def in_a_line(text):
    return " ".join(text.split())


@cache
def rocking():
    return masonry.run(masonry.load("block-rocking", {"solver.duration": "0.05 s"}))


def test_where_nothing_settles_and_nothing_is_damped_neither_is_told():
    summary, text = rocking().summary, in_a_line(summary_text(rocking().summary))
    assert summary["unbalanced_after_settling"] is None and summary["kinetic_after_settling"] is None
    assert summary["damping_over_external"] == 0.0
    assert "settling" not in text and "at the end inertia makes" in text and "damping" not in text
    damped = summary | {"energy_j": {**summary["energy_j"], "damping": 1e-6}}
    assert "at the end damping and inertia make" in in_a_line(summary_text(damped))


def test_a_collapse_is_told_with_its_place_at_the_start_and_no_rounding():
    text = collapse_text(FALLEN)
    assert (
        text == "block 3 (keystone), at (0, 0.15, 0.98) m at the start, is the first to fall, after 1 s; the fall "
        "began after 0.5 s"
    )
    tilted = collapse_text(FALLEN | {"began": BEGAN | {"tilt_rad": 0.37}})
    assert tilted.endswith("it falls at a smaller tilt already, as gravity turned on while the fall gained speed")


def test_a_load_that_grows_while_the_fall_gathers_way_is_told_from_where_to_where():
    """The block slides at a share of 0.3 of its weight over 20 N: 0.294. It shows a quarter later."""
    block = box("block", (0.05, -0.05, 0.0), (0.1, 0.1, 0.1), "units", 1)
    push = '[[traction]]\non = "block.x-"\nstress = {x = "2 kPa"}\nhistory = [["0 s", 0], ["0.3 s", 1]]\n'
    result = laboratory.run(dry([slab(0.4), block], 0.3, duration=0.8, more=push, settle=2000))
    fallen = result.summary["collapse"]
    assert fallen["began"] is None and fallen["loads"] == {"traction.0": 1.0}
    shares = re.search(r"the traction\.0 went from ([\d.]+) to ([\d.]+) of its value", fallen["began_unknown"])
    assert shares is not None
    assert float(shares[1]) == pytest.approx(0.3 * 2000.0 * 1e-3 * 9.81 / 20.0, rel=0.05)
    assert float(shares[2]) > 1.2 * float(shares[1])
    assert f"is not known: {fallen['began_unknown']}" in in_a_line(summary_text(result.summary))
    known = collapse_text(FALLEN | {"began": BEGAN | {"loads": {"traction.0": 0.37}}})
    assert known.endswith("with traction.0 at 0.37 of its value")


def test_gauges_of_what_fell_say_until_when_they_count():
    """Their numbers are those of the rows until the first block had fallen."""
    swing = GaugeSwing(peak=-0.2807, time_s=0.988, residual=-1.2)
    shaking = Shaking(gauges={"top": swing}, largest_force=LargestForce(12.0, 0.5, "a and b"))
    stood, fell = (dict(shaking_rows(shaking, falls)) for falls in (False, True))
    assert stood["top"] == ["-280.7 mm at most, after 0.988 s; -1200 mm left at the end"]
    assert fell["top"] == [
        "-280.7 mm at most until the first block had fallen, after 0.988 s; -1200 mm left at the end"
    ]
    assert fell["contact force"] == ["12 N at most until the first block had fallen, after 0.5 s: a and b"]
    summary = rocking().summary | {"shaking": shaking, "collapse": FALLEN}
    assert "until the first block had fallen" in in_a_line(summary_text(summary))


@pytest.mark.parametrize(
    ("scene", "law", "meet"),
    [
        ("block-rocking", "law friction", "1 pair of 2 convex pieces is near enough to be looked at; "),
        ("couplet-slid-off", "law exponential, friction", "(1 that bonds hold is left out)"),
        ("wall-pushed-over", "law exponential, friction", "(66 that bonds hold are left out)"),
    ],
)
def test_laws_and_pairs_are_told_as_they_act(scene, law, meet):
    loaded = masonry.load(scene)
    words = compiling_text(assemble(loaded).model).partition("blocks, ")[2].partition(" (")[0]
    assert words == law
    assert meet in in_a_line(check_text(laboratory.check(loaded)))
