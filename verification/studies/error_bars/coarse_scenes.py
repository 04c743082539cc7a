"""Scenes in which an error of resolution is large by itself: joints and tets that bend, plates that twist, toes."""

from typing import Any

import numpy as np

from masonry.scene import Scene, load
from verification.studies.error_bars.random_scenes import LAWS, Draw

STEEL = {"density": "7850 kg/m^3"}


def _millimetres(draw: Draw, low: float, high: float) -> str:
    return f"{1e3 * draw.uniform(low, high):.4g} mm"


def _tower(draw: Draw, rule: str) -> dict[str, Any]:
    """Units on each other between two plates, the upper one pushed aside."""
    normal = draw.uniform(2.0, 40.0)
    return {
        "kinematics": "rigid",
        "specimen": {
            "kind": "prism",
            "units": int(draw.integers(1, 6)),
            "length": _millimetres(draw, 0.15, 0.3),
            "width": _millimetres(draw, 0.1, 0.3),
            "height": _millimetres(draw, 0.08, 0.25),
            "plates": "40 mm",
            "contact_points": rule,
            "points_per_edge": int(draw.integers(2, 6)),
        },
        "material": {"units": {"density": "1900 kg/m^3"}, "plates": STEEL},
        "contact": {
            group: {"normal_stiffness": f"{normal:.4g} GPa/m", "shear_stiffness": f"{0.4 * normal:.4g} GPa/m"}
            for group in ("unit_unit", "plate")
        },
        "support": [
            {"on": "bottom plate", "fix": "all"},
            {"on": "top plate", "fix": ["y", "rotation x", "rotation z"]},
        ],
    }


def _closed_tower(draw: Draw) -> dict[str, Any]:
    push = {"on": "top plate", "direction": "x", "displacement": _millimetres(draw, 1e-4, 5e-4), "accuracy": 0.01}
    return _tower(draw, str(draw.choice(["vertex", "gauss"]))) | {"law": "elastic", "drive": push}


def _bent_pier(draw: Draw) -> dict[str, Any]:
    """Glued, pressed and pushed aside until it bends open."""
    scene = _tower(draw, str(draw.choice(["vertex", "gauss"])))
    strength = draw.uniform(0.1, 0.6)
    tough = {
        "tensile_strength": f"{strength:.4g} MPa",
        "cohesion": f"{1.5 * strength:.4g} MPa",
        "tan_friction_angle": 0.75,
        "fracture_energy_mode_1": f"{draw.uniform(5.0, 50.0):.4g} N/m",
        "fracture_energy_mode_2": "200 N/m",
    }
    for contact in scene["contact"].values():
        contact |= tough
    push = {"on": "top plate", "direction": "x", "displacement": _millimetres(draw, 1e-3, 4e-3), "accuracy": 0.02}
    pressure = f"-{draw.uniform(0.05, 1.0):.4g} MPa"
    traction = [{"on": "top plate.z+", "stress": {"z": pressure}}]
    return scene | {"law": str(draw.choice(LAWS)), "drive": push, "traction": traction, "settle": {"steps": 8000}}


def _cantilever(draw: Draw) -> dict[str, Any]:
    """Of tets, glued to a plate."""
    scene = _tower(draw, "vertex")
    del scene["specimen"]["points_per_edge"], scene["specimen"]["contact_points"]
    scene["specimen"] |= {"units": 1, "height": _millimetres(draw, 0.2, 0.6)}
    scene["specimen"] |= {"mesh_size": _millimetres(draw, 0.05, 0.12)}
    scene["kinematics"] = {"default": "tets", "plates": "rigid"}
    young = {"young_modulus": f"{draw.uniform(1.0, 10.0):.4g} GPa", "poisson_ratio": float(draw.uniform(0.0, 0.3))}
    scene["material"]["units"] |= young
    push = {"on": "top plate", "direction": "x", "displacement": _millimetres(draw, 1e-4, 5e-4), "accuracy": 0.02}
    return scene | {"law": "elastic", "drive": push}


def _boxes(draw: Draw, block: list[str], more: dict[str, Any]) -> dict[str, Any]:
    """A block on a slab, dry."""
    slab = {"name": "slab", "origin": ["-1 m", "-1 m", "-0.3 m"], "size": ["3 m", "3 m", "0.3 m"], "unit": 0}
    box = {"name": "block", "origin": ["0 m", "0 m", "0 m"], "size": block, "unit": 1}
    return {
        "law": "friction",
        "kinematics": "rigid",
        "specimen": {"kind": "boxes", "section": "0.1 m^2", "box": [slab, box], **more},
        "material": {"units": {"density": "2000 kg/m^3"}},
        "contact": {
            "unit_unit": {
                "normal_stiffness": "20 GPa/m",
                "shear_stiffness": "8 GPa/m",
                "tan_friction_angle": float(draw.uniform(0.4, 0.7)),
            }
        },
        "support": [{"on": "slab", "fix": "all"}],
        "gravity": {"z": "-9.81 m/s^2"},
    }


def _twisted_plate(draw: Draw) -> dict[str, Any]:
    """Pushed along its side."""
    length, width = draw.uniform(0.2, 0.6, 2)
    size = [f"{length:.4g} m", f"{width:.4g} m", "0.1 m"]
    more = {"contact_points": str(draw.choice(["vertex", "gauss"])), "points_per_edge": int(draw.integers(2, 5))}
    push: dict[str, Any] = {"pattern": "force", "on": "block", "force": {"y": "100 N"}, "up_to": 1000.0}
    push |= {"at": [f"{length:.4g} m", f"{draw.uniform(0, width):.4g} m", "0 m"]}
    return _boxes(draw, size, more) | {"limit": push | {"accuracy": float(draw.choice([0.005, 0.02]))}}


def _toes(draw: Draw) -> dict[str, Any]:
    """Dry units between plates, pressed and pushed aside until their toes crush."""
    scene, is_large, along = _tower(draw, "vertex"), bool(draw.random() < 0.5), int(draw.integers(2, 9))
    more = {"patch_points_per_edge": 2 * max(along // 2, 1)} if is_large else {"points_per_edge": along}
    del scene["specimen"]["points_per_edge"], scene["specimen"]["contact_points"]
    scene["specimen"] |= more | {"units": int(draw.integers(1, 3))}
    strength = draw.uniform(2.0, 10.0)
    for contact in scene["contact"].values():
        contact |= {"tan_friction_angle": 0.8, "compressive_strength": f"{strength:.4g} MPa", "crushing": "cut-off"}
    pressure = f"-{strength * draw.uniform(0.03, 0.2):.4g} MPa"
    push = {"on": "top plate", "direction": "x", "displacement": _millimetres(draw, 1e-3, 4e-3), "accuracy": 0.02}
    scene |= {"traction": [{"on": "top plate.z+", "stress": {"z": pressure}}], "settle": {"steps": 8000}}
    return scene | {"law": "friction", "drive": push} | ({"displacements": "large"} if is_large else {})


COARSE = {
    "tower that stays closed": _closed_tower,
    "pier that bends": _bent_pier,
    "cantilever of tets": _cantilever,
    "plate that twists": _twisted_plate,
    "toe that crushes": _toes,
}


def coarse_scene_of(kind: str, seed: int) -> Scene:
    """The scene of a kind and a seed."""
    draw = np.random.default_rng([seed, list(COARSE).index(kind), 85])
    return load({**COARSE[kind](draw), "name": f"{kind.replace(' ', '-')}-{seed}"})
