"""Scenes of many kinds with sizes and values by seed, small enough for a truth by brute force."""

from collections.abc import Callable
from typing import Any

import numpy as np

from masonry.scene import Scene, load

Draw = np.random.Generator
LAWS = ("brittle", "linear", "exponential")


def _length(draw: Draw, low: float, high: float) -> str:
    return f"{1e3 * draw.uniform(low, high):.4g} mm"


def _stress(draw: Draw, low: float, high: float) -> str:
    return f"{draw.uniform(low, high):.4g} MPa"


def _couplet(draw: Draw) -> dict[str, Any]:
    return {
        "base": "couplet",
        "law": str(draw.choice(LAWS)),
        "confinement": _stress(draw, 0.05, 1.0),
        "specimen": {"length": _length(draw, 0.1, 0.3), "height": _length(draw, 0.04, 0.12)},
        "drive": {"displacement": _length(draw, 2e-4, 1.5e-3)},
    }


def _couplet_to_and_fro(draw: Draw) -> dict[str, Any]:
    way = draw.uniform(2e-5, 4e-4, 3)
    return _couplet(draw) | {
        "base": "couplet-cyclic",
        "drive": {"history": [f"{1e3 * sign * u:.4g} mm" for sign, u in zip((1, -1, 1), np.sort(way), strict=True)]},
    }


def _couplet_in_tension(draw: Draw) -> dict[str, Any]:
    """Pulled beside its middle: it opens from one edge."""
    return {
        "base": "couplet",
        "law": str(draw.choice(LAWS)),
        "confinement": "0 MPa",
        "specimen": {"length": _length(draw, 0.1, 0.3), "height": _length(draw, 0.05, 0.15)},
        "support": [{"on": "bottom", "fix": "all"}, {"on": "top", "fix": ["y", "rotation x", "rotation z"]}],
        "drive": {"direction": "x", "displacement": _length(draw, 1e-4, 4e-4)},
    }


def _triplet(draw: Draw) -> dict[str, Any]:
    return {
        "base": "triplet-dry",
        "confinement": _stress(draw, 0.05, 1.0),
        "contact": {"unit_unit": {"tan_friction_angle": float(draw.uniform(0.4, 0.9))}},
        "specimen": {"length": _length(draw, 0.15, 0.35), "height": _length(draw, 0.04, 0.1)},
    }


def _wallette(draw: Draw) -> dict[str, Any]:
    strength = draw.uniform(0.05, 0.4)
    joint = {"tensile_strength": f"{strength:.4g} MPa", "cohesion": f"{strength * draw.uniform(1.2, 2.0):.4g} MPa"}
    return {
        "base": "wallette-mode-1",
        "law": str(draw.choice(LAWS)),
        "specimen": {
            "courses": int(draw.integers(2, 5)),
            "units_per_course": int(draw.integers(1, 3)),
            "unit_length": _length(draw, 0.18, 0.3),
            "divisions": [int(2 * draw.integers(1, 3)), int(draw.integers(1, 3))],
        },
        "contact": {"unit_unit": joint},
        "drive": {"displacement": _length(draw, 1e-4, 5e-4), "accuracy": float(draw.choice([0.01, 0.02, 0.05]))},
    }


def _column(draw: Draw) -> dict[str, Any]:
    return {
        "base": "column-pushed",
        "specimen": {
            "drums": int(draw.integers(2, 5)),
            "height": _length(draw, 1.5, 3.5),
            "sides": int(draw.choice([4, 6, 8, 12])),
        },
        "contact": {"unit_unit": {"tan_friction_angle": float(draw.uniform(0.5, 0.8))}},
        "drive": {"displacement": _length(draw, 4e-3, 2e-2), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def _tilted_wall(draw: Draw) -> dict[str, Any]:
    return {
        "base": "wall-tilted",
        "specimen": {
            "courses": int(draw.integers(3, 7)),
            "units_per_course": int(draw.integers(2, 5)),
            "unit_length": _length(draw, 0.25, 0.5),
        },
        "contact": {"unit_unit": {"tan_friction_angle": float(draw.uniform(0.5, 0.8))}},
    }


def _tied_wall(draw: Draw) -> dict[str, Any]:
    return {
        "base": "wall-tied",
        "specimen": {"thickness": _length(draw, 0.25, 0.4)},
        "bar": [
            {
                "ends": [["0.6 m", "0.15 m", "1.65 m"], ["0.6 m", "2.15 m", "1.65 m"]],
                "fixed_end": "second",
                "area": "1.13 cm^2",
                "young_modulus": "210 GPa",
                "strength": _stress(draw, 5.0, 25.0),
                "repeat": 2,
                "spacing": ["1.8 m", "0 m", "0 m"],
            }
        ],
        "limit": {"accuracy": float(draw.choice([0.005, 0.02]))},
    }


def _prism(draw: Draw) -> dict[str, Any]:
    return {
        "base": "prism-in-compression",
        "specimen": {"length": _length(draw, 0.15, 0.25)},
        "drive": {"displacement": _length(draw, 8e-4, 1.4e-3), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def _arch(draw: Draw) -> dict[str, Any]:
    return {
        "base": "arch-spread",
        "specimen": {
            "voussoirs": int(draw.integers(5, 14)),
            "angle": f"{draw.uniform(110, 180):.4g} deg",
            "thickness": _length(draw, 0.13, 0.25),
            "points_per_edge": int(draw.integers(2, 4)),
        },
        "drive": {"history": [f"-{draw.uniform(0.2, 2.0):.4g} mm"]},
    }


def _crushing_wall(draw: Draw) -> dict[str, Any]:
    return {
        "base": "shear-wall-size",
        "confinement": _stress(draw, 0.3, 1.2),
        "specimen": {
            "courses": int(draw.integers(3, 6)),
            "units_per_course": int(draw.integers(2, 4)),
            "divisions": [1, 1],
            "points_per_edge": {"x": int(draw.integers(4, 9)), "z": 3},
        },
        "drive": {"displacement": _length(draw, 2e-3, 6e-3), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def _affine(draw: Draw) -> dict[str, Any]:
    return _wallette(draw) | {"kinematics": {"default": "affine", "plates": "rigid"}}


def _tets(draw: Draw) -> dict[str, Any]:
    scene = _couplet(draw) | {"kinematics": "tets"}
    scene["specimen"] |= {"mesh_size": _length(draw, 0.02, 0.05)}
    scene["support"] = [{"on": "bottom.z-", "fix": ["x", "y", "z"]}, {"on": "top", "fix": ["y"]}]
    scene["drive"] = {"on": "top.z+", "direction": "x", "displacement": _length(draw, 5e-5, 2e-4)}
    return scene


def _elastic_shaking(draw: Draw) -> dict[str, Any]:
    """A glued column on ground that moves: nothing cracks."""
    size, frequency = draw.uniform(0.5, 2.0), draw.uniform(3.0, 12.0)
    return {
        "law": "elastic",
        "kinematics": "rigid",
        "specimen": {
            "kind": "prism",
            "units": int(draw.integers(2, 5)),
            "length": _length(draw, 0.2, 0.4),
            "width": _length(draw, 0.2, 0.3),
            "height": _length(draw, 0.2, 0.4),
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


def _large(draw: Draw) -> dict[str, Any]:
    return _triplet(draw) | {"displacements": "large"}


KINDS: dict[str, Callable[[Draw], dict[str, Any]]] = {
    "couplet": _couplet,
    "couplet to and fro": _couplet_to_and_fro,
    "couplet that opens": _couplet_in_tension,
    "dry triplet": _triplet,
    "wallette": _wallette,
    "dry column": _column,
    "tilted dry wall": _tilted_wall,
    "dry wall on ties": _tied_wall,
    "prism that crushes": _prism,
    "dry arch": _arch,
    "wall whose toes crush": _crushing_wall,
    "wallette of affine blocks": _affine,
    "couplet of tets": _tets,
    "shaken glued column": _elastic_shaking,
    "dry triplet in large displacement": _large,
}


def scene_of(kind: str, seed: int) -> Scene:
    """The scene of a kind and a seed."""
    draw = np.random.default_rng([seed, list(KINDS).index(kind)])
    return load({**KINDS[kind](draw), "name": f"{kind.replace(' ', '-')}-{seed}"})
