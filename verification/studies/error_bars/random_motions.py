"""Random scenes that move in real time."""

from typing import Any

import numpy as np

from verification.studies.error_bars.draws import Draw, length


def glued_column(draw: Draw) -> dict[str, Any]:
    """A glued column on ground that moves: nothing cracks."""
    size, frequency = draw.uniform(0.5, 2.0), draw.uniform(3.0, 12.0)
    return {
        "law": "elastic",
        "kinematics": "rigid",
        "specimen": {
            "kind": "prism",
            "units": int(draw.integers(2, 5)),
            "length": length(draw, 0.2, 0.4),
            "width": length(draw, 0.2, 0.3),
            "height": length(draw, 0.2, 0.4),
        },
        "material": {"units": {"density": "1900 kg/m^3"}},
        "contact": {
            "unit_unit": {
                "normal_stiffness": f"{draw.uniform(0.05, 0.5):.4g} GPa/m",
                "shear_stiffness": f"{draw.uniform(0.05, 0.2):.4g} GPa/m",
            }
        },
        "support": [{"on": "bottom", "fix": "all"}],
        "gravity": {"z": "-9.81 m/s^2"},
        "settle": {"steps": 4000},
        "ground": {"x": f"{0.1 * size:.4g} g * sin(2 * pi * {frequency:.4g} * t / (1 s))", "duration": "1.5 s"},
        "damping": {"rayleigh": {"ratio": "3 %", "between": ["5 Hz", "60 Hz"]}},
        "solver": {"duration": "2 s", "step_fraction": float(draw.choice([0.9, 0.5]))},
        "gauge": [{"name": "sway", "at": "top", "direction": "x"}],
    }


def sliding_block(draw: Draw) -> dict[str, Any]:
    """A dry block on one that moves with the ground, further than friction lets it follow."""
    scene = glued_column(draw)
    friction, frequency = draw.uniform(0.2, 0.6), draw.uniform(2.0, 6.0)
    scene["law"] = "friction"
    scene["specimen"] |= {"units": 2, "height": length(draw, 0.1, 0.2)}
    scene["contact"]["unit_unit"] = {
        "normal_stiffness": f"{draw.uniform(1.0, 4.0):.4g} GPa/m",
        "shear_stiffness": f"{draw.uniform(0.5, 2.0):.4g} GPa/m",
        "tan_friction_angle": float(friction),
    }
    wave = f"sin(2 * pi * {frequency:.4g} * t / (1 s))"
    scene["ground"]["x"] = f"{friction * draw.uniform(1.1, 2.0):.4g} g * {wave}"
    scene["settle"] = {"steps": 2000}
    scene["ground"]["duration"], scene["solver"]["duration"] = "1 s", "1.2 s"
    scene["gauge"] = [{"name": "slip", "at": "top", "direction": "x", "relative_to": "bottom"}]
    return scene


def rocking_block(draw: Draw) -> dict[str, Any]:
    """It leans by a part of its slenderness, is let go, and rocks from edge to edge."""
    width, height = draw.uniform(0.15, 0.35), draw.uniform(0.6, 1.2)
    angle = draw.uniform(0.2, 0.7) * float(np.arctan(width / height))
    return {
        "base": "block-rocking",
        "specimen": {
            "turned": {"about": "y", "angle": f"{angle:.6g} rad"},
            "box": [
                {
                    "name": "block",
                    "origin": [f"-{width:.4g} m", "0 m", "0 m"],
                    "size": [f"{width:.4g} m", "0.5 m", f"{height:.4g} m"],
                }
            ],
        },
        "contact": {"floor_units": {"normal_stiffness": f"{draw.uniform(0.2, 2.0):.4g} GPa/m"}},
        "solver": {"duration": "0.7 s"},
    }
