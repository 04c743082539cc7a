"""Scenes whose answers were once wrong in their resolution, under a good verdict: the error bar holds the right one."""

from typing import Any

import numpy as np
import pytest

from masonry.laboratory import laboratory
from masonry.scene import changed, load
from masonry.sweeps.convergence.convergence import converge


def boxes(*sizes: tuple[tuple[float, ...], tuple[float, ...]], **words: Any) -> dict[str, Any]:
    """Boxes with a corner and edges in metres, that with the number 0 held."""
    box = [
        {
            "name": f"box {number}",
            "unit": number,
            "origin": [f"{x} m" for x in origin],
            "size": [f"{x} m" for x in size],
        }
        for number, (origin, size) in enumerate(sizes)
    ]
    return {
        "kinematics": "rigid",
        "specimen": {"kind": "boxes", "section": "0.2 m^2", "box": box} | words,
        "material": {"units": {"density": "2000 kg/m^3"}},
        "support": [{"on": "box 0", "fix": "all"}],
    }


def joint(normal: float, shear: float, friction: float, **words: Any) -> dict[str, Any]:
    """Of units, with stiffness in GPa/m."""
    return {
        "unit_unit": {
            "normal_stiffness": f"{normal} GPa/m",
            "shear_stiffness": f"{shear} GPa/m",
            "tan_friction_angle": friction,
        }
        | words
    }


SIDE, PRESSURE, FRICTION = 0.4, 1e6, 0.5
TWISTED = boxes(((-1.0, -1.0, -0.2), (3.0, 3.0, 0.2)), ((0.0, 0.0, 0.0), (SIDE, SIDE, 0.1)), contact_points="gauss") | {
    "law": "friction",
    "contact": joint(20, 8, FRICTION),
    "gravity": {"z": "-9.81 m/s^2"},
    "traction": [{"on": "box 1.z+", "stress": {"z": f"-{PRESSURE} Pa"}}],
    "limit": {
        "pattern": "force",
        "on": "box 1",
        "at": [f"{SIDE} m", f"{SIDE / 2} m", "0 m"],
        "force": {"y": "1 kN"},
        "accuracy": "0.5 %",
        "up_to": 1e4,
    },
}
"""A dry plate under even pressure, pushed at its edge: it turns as it slides. With the usual points of a joint 46.9."""

DEEP, FORCE, STRENGTH = 0.2, 2e5, 5e6
CRUSHED = boxes(((0.0, 0.0, 0.0), (1.0, DEEP, 0.2)), ((0.0, 0.0, 0.2), (1.0, DEEP, 2.0))) | {
    "law": "friction",
    "contact": joint(50, 20, 2.0, crushing="cut-off", compressive_strength=f"{STRENGTH} Pa"),
    "traction": [{"on": "box 1.z+", "stress": {"z": f"-{FORCE / DEEP} Pa"}}],
    "drive": {"on": "box 1", "direction": "y", "displacement": "4 mm", "accuracy": "0.5 %"},
}
CRUSHED["support"] = [*CRUSHED["support"], {"on": "box 1", "fix": ["x", "rotation y", "rotation z"]}]
"""Pushed across its thickness, a metre above its bed, until its toe crushes. It was 11.6 kN once."""

BENT = boxes(((-0.1, 0.0, -0.1), (0.4, 0.1, 0.1)), ((0.0, 0.0, 0.0), (0.2, 0.1, 0.5))) | {
    "law": "exponential",
    "contact": joint(
        80,
        35,
        0.7,
        tensile_strength="0.2 MPa",
        cohesion="0.3 MPa",
        fracture_energy_mode_1="10 N/m",
        fracture_energy_mode_2="50 N/m",
    ),
    "drive": {"on": "box 1", "direction": "x", "displacement": "1 mm", "accuracy": "1 %"},
}
BENT["support"] = [*BENT["support"], {"on": "box 1", "fix": ["y", "rotation x", "rotation z"]}]
"""A glued block, pushed until its bed tears off from one edge; no weight."""


def twisting() -> float:
    """Least force in kN by which a square slides, over all centres of its turning on the line through its middle, as a
    sum over small cells: the power of the force is that of friction under an even pressure."""
    pressure = PRESSURE + 0.1 * 2000.0 * 9.81
    cells = (np.arange(400) + 0.5) / 400 * SIDE
    x, y = np.meshgrid(cells, cells - SIDE / 2)
    centres = np.linspace(-SIDE, 0.9 * SIDE, 800)
    powers = [np.mean(np.hypot(x - c, y)) * SIDE**2 * FRICTION * pressure / (SIDE - c) for c in centres]
    return min(powers) / 1e3


def crushing() -> float:
    """Pa over the section, with 48 points across the bed. By hand a little more, were it pushed without end: the force
    then stands on a stress block at the edge, and the push acts a metre above."""
    fine = changed(load(CRUSHED), {"specimen.points_per_edge": {"x": 2, "y": 48, "z": 2}, "drive.accuracy": 0.0025})
    peak = laboratory.run(fine).summary["peak_stress_pa"]
    by_hand = FORCE * DEEP / 2 * (1.0 - FORCE / (DEEP * STRENGTH)) / 1.0 / 0.2
    assert 0.99 * by_hand < peak < by_hand
    return float(peak)


def tearing() -> float:
    """Pa over the section, with 128 points along the bed."""
    fine = changed(load(BENT), {"specimen.points_per_edge": {"x": 128, "y": 2, "z": 2}})
    return laboratory.run(fine).summary["peak_stress_pa"]


@pytest.mark.parametrize(
    ("scene", "number", "right", "width"),
    [
        (TWISTED, "collapse_load.borne", twisting, 0.06),
        (CRUSHED, "peak_stress_pa", crushing, 0.1),
        (BENT, "peak_stress_pa", tearing, 0.25),
    ],
    ids=["a dry plate twists", "a toe crushes", "a bed tears off"],
)
def test_the_bar_holds_the_right_answer(scene, number, right, width, tmp_path):
    error = converge(load(scene), tmp_path / "out", of=[number], workers=0).errors[0]
    assert abs(error.limit - right()) <= error.half_width <= width * error.value
    assert abs(error.value - right()) > 0.01 * right(), "wrong as it is: else the bar has nothing to hold"
