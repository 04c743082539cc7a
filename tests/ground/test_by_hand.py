"""Shaken scenes against integrations of their own: blocks that slide on each other, an arch whose abutment moves."""

from functools import cache
from math import cos, sin

import numpy as np
import pytest

import masonry
from masonry.scene import load
from tests import scenes

G = 9.80665
SLOPE = float(np.radians(8.0))
SHAKING = {"x": (0.3, 0.4), "z": (0.5, 0.15)}
"""g and s of sines along and across the slope, under an envelope of half a sine of a second."""
FRICTION, MASSES = (0.25, 0.2), np.array([400.0, 100.0])


def acceleration(axis, time):
    """m/s2 of the ground."""
    peak, period = SHAKING[axis]
    return peak * G * np.sin(2 * np.pi * time / period) * np.sin(np.pi * time)


@cache
def slides(step=1e-4):
    """(2,) m: how far two blocks, one on the other, slide down in a second, by impulses of Coulomb's friction."""
    velocity, place = np.zeros(2), np.zeros(2)
    borne = np.array([MASSES.sum(), MASSES[1]])
    times = step * (0.5 + np.arange(round(1.0 / step)))
    for along, across in zip(acceleration("x", times), acceleration("z", times), strict=True):
        most = FRICTION * borne * (G * np.cos(SLOPE) + across) * step
        momentum = MASSES * (velocity + (G * np.sin(SLOPE) - along) * step)
        low, high = 0.0, 0.0
        for _ in range(12):
            low = np.clip(high - momentum[0], -most[0], most[0])
            apart = (momentum[1] + high) / MASSES[1] - (momentum[0] + low - high) / MASSES[0]
            high = np.clip(high - apart / (1.0 / MASSES).sum(), -most[1], most[1])
        velocity = (momentum + np.array([low - high, high])) / MASSES
        place += velocity * step
    return place


def stack(tmp_path, away, **keys):
    """Two blocks on a table that leans, seen from the table; `away` (m) from the origin along x."""
    boxes = [
        scenes.box("table", (away - 3, -2, -0.5), (6, 4, 0.5), "tables", 0),
        scenes.box("low", (away - 1, -0.5, 0), (2, 1, 0.1), "lows", 1),
        scenes.box("high", (away - 0.5, -0.5, 0.1), (1, 1, 0.1), "highs", 2),
    ]
    weights = {"tables": 2000, "lows": 2000, "highs": 1000}
    stiff = 'normal_stiffness = "40 GPa/m"\nshear_stiffness = "40 GPa/m"\ntan_friction_angle = '
    sines = [
        f'{axis} = "{peak} g * sin(2 pi t / {period} s) * sin(pi t / 1 s)"' for axis, (peak, period) in SHAKING.items()
    ]
    text = 'law = "friction"\ndisplacements = "large"\n' + scenes.specimen(boxes, 1.0)
    text += scenes.tables("material", {name: f'density = "{weight} kg/m^3"' for name, weight in weights.items()})
    text += scenes.tables("contact", {"lows_tables": f"{stiff}{FRICTION[0]}", "highs_lows": f"{stiff}{FRICTION[1]}",
                                      "highs_tables": f"{stiff}0.5"})  # fmt: skip
    text += '[[support]]\non = "table"\nfix = "all"\n[solver]\ndamping = 0\n[ground]\nduration = "1 s"\n'
    text += "\n".join(sines)
    text += f'\n[gravity]\nx = "{G * sin(SLOPE)!r} m/s^2"\nz = "{-G * cos(SLOPE)!r} m/s^2"\n'
    text += scenes.listed("gauge", [f'name = "{name}"\nat = "{name}"\ndirection = "x"\nrelative_to = "table"'
                                    for name in ("low", "high")])  # fmt: skip
    (tmp_path / "stack.toml").write_text(text)
    return load(tmp_path / "stack.toml", keys)


@pytest.mark.parametrize(("away", "frame"), [(0.0, "inertia"), (1e4, "base")])
def test_a_stack_slides_down_a_slope_at_two_levels_as_the_ground_shakes_along_and_across(tmp_path, away, frame):
    result = masonry.run(stack(tmp_path, away, **{"ground.as": frame}))
    slid = [float(result.curve[name].iloc[-1]) for name in ("low", "high")]
    assert slid == pytest.approx(slides(), rel=2e-3)
    assert result.curve["imbalance"].abs().max() < 1e-9


def test_the_crown_of_an_arch_drops_as_a_record_moves_one_abutment_away():
    """Three hinges, as the thrust is least: at the extrados of the crown, and at the intrados of the second joint from
    each springing, about which each half turns."""
    away, thick, parts = 4e-3, 0.15, 14
    haunch = 2 * np.pi / parts
    lever = np.array([np.cos(haunch), np.sin(haunch)]) * (1.0 - 0.5 * thick)
    drop = 0.5 * away * lever[0] / (1.0 + 0.5 * thick - lever[1])
    stiff = {f"contact.unit_unit.{axis}_stiffness": f"{k} GPa/m" for axis, k in {"normal": 100, "shear": 40}.items()}
    ground = {"on": "right abutment", "as": "base", "quantity": "displacement", "duration": "2 s"}
    keys = {
        "ground": [ground | {"x": "2 mm * (1 - cos(pi t / 2 s))"}],
        "solver.duration": "2.2 s",
        "specimen.voussoirs": parts,
        "gauge": [{"name": "crown", "at": {"x": "middle", "z": "1.07 m"}, "direction": "z"}],
        "curve": None,
    }
    result = masonry.run(load("arch-shaken", stiff | keys))
    rows = result.history.rows["crown"]
    assert rows[0] - rows[-1] == pytest.approx(drop, rel=0.01)
