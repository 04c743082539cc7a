"""sweep.png says which curve is which: a colour for each combination of few, else for each value of one key."""

import pytest
from matplotlib.figure import Figure

from masonry.scene import load
from masonry.sweeps.job import Job
from masonry.sweeps.pictures import sweep_curves as sweep_picture
from masonry.sweeps.pictures.varied_keys import key_words, value_text
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.work import OK
from tests.ground.test_ground_keys import BLOCK, SINE


def planned(*runs):
    return [Planned(Job("couplet"), dict(values), {}) for values in runs]


def grid(first, second):
    return planned(*({"confinement": a, "solver.damping": b} for a in first for b in second))


def test_few_combinations_of_two_keys_have_a_colour_and_a_name_each(tmp_path, monkeypatch):
    runs = grid(["0.1 MPa", "0.2 MPa", "0.3 MPa"], [0.7, 0.8])
    rows = [{"key": f"{n}", "status": OK} for n in range(6)]
    for row in rows:
        folder = tmp_path / "runs" / row["key"]
        folder.mkdir(parents=True)
        (folder / "curve.csv").write_text("displacement [m],stress [Pa]\n0,0\n1,1\n")
    drawn: list[Figure] = []
    monkeypatch.setattr(sweep_picture, "write_picture", lambda figure, path: drawn.append(figure))
    monkeypatch.setattr(sweep_picture, "ResultFiles", Quiet)
    assert sweep_picture.draw(tmp_path, "two keys", runs, rows, "png") == "sweep.png"
    axes = drawn[0].axes[0]
    assert len({tuple(line.get_color()) for line in axes.lines}) == 6
    legend = axes.get_legend()
    assert legend.get_title().get_text() == "confinement, damping (solver)"
    assert axes.get_title() == "two keys: 6 runs"
    assert [text.get_text() for text in legend.get_texts()][:2] == ["0.1 MPa, 0.7", "0.1 MPa, 0.8"]


def test_where_the_ground_moves_the_first_gauge_is_drawn_over_time(tmp_path):
    (tmp_path / "block.toml").write_text(BLOCK)
    keys = {"ground": SINE, "gauge": [{"name": "top left", "at": "block", "direction": "x"}]}
    run = Planned(Job(tmp_path / "block.toml", keys), {}, {})
    (tmp_path / "curve.csv").write_text("displacement [m],stress [Pa],top left [m],time [s]\n0,1,2,3\n0,1,4,5\n")
    across, up = sweep_picture._curve(tmp_path / "curve.csv", pair := sweep_picture._axes_of(run))
    assert across.tolist() == [3.0, 5.0] and up.tolist() == [2.0, 4.0]
    assert [axis.label for axis in pair] == ["time [s]", "top left [mm]"]


class Quiet:
    """Files that nobody writes."""

    def __init__(self, folder):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *error):
        pass

    def new(self, name):
        return name


@pytest.mark.parametrize(
    ("runs", "words", "different"),
    [
        (grid(["1 kPa"], [0.7, 0.8]), "damping (solver)", 2),
        (planned({"confinement": "1 kPa", "law": "a"}, {"confinement": "2 kPa", "law": "b"}), "confinement", 2),
        (grid(["1 kPa", "2 kPa", "3 kPa"], [0.5, 0.6, 0.7, 0.8]), "damping (solver); other keys vary too", 4),
        (planned(*({"confinement": f"{n} kPa"} for n in range(1, 13))), "confinement [kPa]", 12),
    ],
    ids=["one key", "together", "many", "bar"],
)
def test_the_colour_shows_the_key_that_varies(runs, words, different):
    key = sweep_picture.colour_key(runs)
    assert key.words == words and len(set(key.values)) == different and bool(key.names) == (different < 12)


def test_nothing_is_shown_where_nothing_varies():
    assert sweep_picture.colour_key(grid(["1 kPa"], [0.7])) is None


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("contact.unit_unit.tensile_strength", "tensile strength (unit_unit)"),
        ("material.units.density", "density (units)"),
        ("specimen.pier.0.width", "width (specimen.pier.0)"),
        ("displacements", "displacements"),
    ],
)
def test_a_key_is_named_by_what_it_is_and_whose(key, words):
    assert key_words(key) == words


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("24130000000.0 Pa/m", "24.13 GPa/m"),
        ("0.1 MPa", "0.1 MPa"),
        ("0.5235987755982988 rad", "30 deg"),
        (400_000, "400000"),
    ],
)
def test_a_value_has_a_prefix_to_its_unit(value, text):
    assert value_text(value) == text


@pytest.mark.parametrize(
    ("scene", "across", "up"),
    [
        ("couplet", "displacement [mm]", "stress [MPa]"),
        ("wall-tilted", "step", "load factor"),
        ("arch-spread", "displacement [mm]", "stress [MPa]"),
        ("rubble-pile", "time [s]", "kinetic energy [J]"),
        ("block-rocking", "time [s]", None),
    ],
)
def test_what_no_drive_moves_is_drawn_by_its_load_or_over_time(scene, across, up):
    """Its curve.csv has no columns of a drive."""
    pair = sweep_picture._axes_of(Planned(Job(scene), {}, {}))
    gauges = [f"{gauge.name} [mm]" for gauge in load(scene).gauge]
    assert pair[1].label == (up or gauges[0])
    assert pair[0].label == (gauges[0] if up == "load factor" and gauges else across)
