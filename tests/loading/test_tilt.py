"""Gravity that varies: shares of a history, and a tilt test whose blocks slip at tan(tilt) = mu."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.assembly.schedule import plan_of
from masonry.curves.settling_curve import settling_figure
from masonry.laboratory import laboratory
from masonry.laboratory.text import summary_text
from masonry.monitors.reactions import Surroundings
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables

MU, DENSITY, G = 0.4, 1900.0, 9.81
DRY = f'law = "friction"\nnormal_stiffness = "10 GPa/m"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = {MU}'
BOXES = [
    box("base", (-0.3, 0, -0.1), (0.8, 0.2, 0.1), "units", 0),
    box("block", (0, 0, 0), (0.2, 0.2, 0.02), "units", 1),
]
WEIGHT = DENSITY * G * 0.2 * 0.2 * 0.02


def incline(gravity: str, contact: str = DRY, more: str = ""):
    """A flat block on a fixed one."""
    return load(
        specimen(BOXES, 0.04)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": contact})
        + listed("support", ['on = "base"\nfix = "all"'])
        + listed("gauge", ['name = "slide"\nat = "block"\ndirection = "-x"'])
        + f"[gravity]\n{gravity}\n[settle]\nsteps = 1000\n{more}"
    )


def tilt(angle="23 deg", pace="steps = 40000", about="y", vector='z = "-9.81 m/s^2"'):
    return f'{vector}\ntilt = {{about = "{about}", angle = "{angle}", {pace}}}'


@pytest.fixture(scope="module")
def tilted():
    return laboratory.run(incline(tilt(), more='[solver]\ndamping = 0.2\n[curve]\nx = "tilt_of_gravity"\n'))


def test_a_block_slips_where_the_tangent_of_the_tilt_is_the_coefficient_of_friction(tilted):
    rows = tilted.history.rows
    angle, slide = rows["tilt_of_gravity"], rows["slide"]
    elastic = WEIGHT * np.sin(angle) / (5e9 * 0.04)
    slips = int(np.argmax(slide > 10 * elastic.max()))
    assert np.tan(angle[slips]) == pytest.approx(MU, rel=0.005), "it takes a little way to gather speed"
    stands = np.tan(angle) < 0.99 * MU
    assert slide[stands] == pytest.approx(elastic[stands], abs=0.5 * elastic.max())
    assert slide[-1] > 1e4 * elastic.max()


def test_the_summary_says_how_far_gravity_was_turned_and_its_balances_close(tilted):
    summary, rows = tilted.summary, tilted.history.rows
    assert summary["tilt_rad"] == rows["tilt_of_gravity"][-1] == pytest.approx(np.radians(23.0), rel=1e-12)
    assert "tilt of gravity    23 deg at the end, tangent 0.4245" in summary_text(summary)
    assert summary["energy_imbalance"] < 1e-12
    assert summary["force_balance"] < 1e-12
    end = summary["reactions"]["end"]
    force = np.sum([end[name]["force_n"] for name in ("gravity cos", "gravity sin")], axis=0)
    whole = WEIGHT * (1 + 0.8 * 0.2 * 0.1 / (0.2 * 0.2 * 0.02))
    angle = np.radians(23.0)
    assert force == pytest.approx((-whole * np.sin(angle), 0.0, -whole * np.cos(angle)), rel=1e-7, abs=1e-9)


def test_the_slide_is_drawn_over_the_tilt(tilted):
    moved, ledger = settling_figure(tilted).axes
    assert ledger.get_xlabel() == "tilt of gravity [deg]"
    rows = tilted.history.rows
    assert moved.lines[0].get_xdata() == pytest.approx(np.degrees(rows["tilt_of_gravity"]), rel=1e-12)
    assert moved.lines[0].get_ydata() == pytest.approx(1e3 * rows["slide"], rel=1e-12)


@pytest.mark.parametrize(
    ("about", "vector", "across"),
    [
        ("y", (0.0, 0.0, -9.81), (-1.0, 0.0, 0.0)),
        ("x", (0.0, 0.0, -9.81), (0.0, 1.0, 0.0)),
        ("z", (3.0, 0.0, -9.81), (0.0, 1.0, 0.0)),
    ],
)
def test_the_weight_has_its_size_and_direction_at_every_row(about, vector, across):
    given = "\n".join(f'{axis} = "{g} m/s^2"' for axis, g in zip("xyz", vector, strict=True))
    scene = incline(tilt("60 deg", "steps = 3000", about, given), ELASTIC)
    built = assemble(scene)
    pace = built.plan.loading(built.model, 100)
    layout, loads = built.model.layout, built.recording.surroundings
    along = np.eye(3)["xyz".index(about)] * np.array(vector)
    turning = np.array(vector) - along
    mass = DENSITY * float(layout.volume.sum())
    rows = 0
    while (chunk := pace.next()) is not None:
        if not chunk.row or pace.done < 1000:
            continue
        rows += 1
        load_factors = [
            1.0 if load.varies is None else pace.loads.load_factors[load.varies, pace.done] for load in loads.loads
        ]
        found = loads.resultants(built.model, load_factors).sum(axis=0)[:3] / mass
        angle = np.radians(60.0) * (pace.done - 1001) / 3000 if pace.done > 1000 else 0.0
        wanted = along + np.cos(angle) * turning + np.sin(angle) * np.linalg.norm(turning) * np.array(across)
        body = built.model.bodies.rigid
        acting = (body.load + body.change).sum(axis=0)[:3] / mass
        assert np.abs(found - wanted).max() < 1e-6 * G
        assert np.abs(acting - wanted).max() < 1e-6 * G, "what the step is given at the end of the chunk"
    assert rows > 50


def test_a_tilt_in_seconds_takes_its_time():
    scene = incline(tilt(pace='duration = "0.1 s"'))
    dt = assemble(scene).model.dt
    assert (plan_of(scene, dt).steps - 1000) * dt == pytest.approx(0.1, rel=2 * dt / 0.1)


def test_gravity_follows_its_history():
    up = 'z = "-9.81 m/s^2"\nhistory = "1 - 0.5 * ramp(t / 1 s)"\nduration = "1 s"'
    scene = incline(up, ELASTIC).with_({"support.0.on": "base"})
    dt = assemble(scene).model.dt
    scene = incline(up.replace("1 s", f"{20_000 * dt!r} s"), ELASTIC)
    result = laboratory.run(scene)
    end = result.summary["reactions"]["end"]
    assert end["support.0"]["force_n"][2] == pytest.approx(0.5 * WEIGHT + 0.5 * DENSITY * 0.016 * G, rel=1e-3)
    assert result.summary["energy_imbalance"] < 1e-10
    assert result.summary.tilt_rad is None and "tilt_of_gravity" not in result.history.rows


def test_each_part_of_a_tilt_is_a_load_of_its_own():
    conditions = assemble(incline(tilt(about="z", vector='x = "1 m/s^2"\nz = "-9.81 m/s^2"'))).recording.surroundings
    assert isinstance(conditions, Surroundings)
    assert [(load.name, load.varies) for load in conditions.loads] == [
        ("gravity cos", 0),
        ("gravity sin", 1),
        ("gravity", None),
    ]
