"""Scenes of many kinds with sizes and values by seed, small enough for a truth by brute force."""

from collections.abc import Callable
from typing import Any

import numpy as np

from masonry.scene import Scene, load
from masonry.sweeps.convergence.refinement.analyses import frequency_keys
from verification.studies.error_bars.draws import LAWS, Draw, length, stress
from verification.studies.error_bars.random_motions import glued_column, rocking_block, sliding_block
from verification.studies.error_bars.random_walls import (
    arch_under_axle,
    bent_wallette,
    large_tilted_wall,
    rocking_wall,
    standing_wall,
    wall_pushed_forwards,
    wall_to_and_fro,
    wall_with_window,
    wallette_to_and_fro,
)


def _couplet(draw: Draw) -> dict[str, Any]:
    return {
        "base": "couplet",
        "law": str(draw.choice(LAWS)),
        "confinement": stress(draw, 0.05, 1.0),
        "specimen": {"length": length(draw, 0.1, 0.3), "height": length(draw, 0.04, 0.12)},
        "drive": {"displacement": length(draw, 2e-4, 1.5e-3)},
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
        "specimen": {"length": length(draw, 0.1, 0.3), "height": length(draw, 0.05, 0.15)},
        "support": [{"on": "bottom", "fix": "all"}, {"on": "top", "fix": ["y", "rotation x", "rotation z"]}],
        "drive": {"direction": "x", "displacement": length(draw, 1e-4, 4e-4)},
    }


def _triplet(draw: Draw) -> dict[str, Any]:
    return {
        "base": "triplet-dry",
        "confinement": stress(draw, 0.05, 1.0),
        "contact": {"unit_unit": {"tan_friction_angle": float(draw.uniform(0.4, 0.9))}},
        "specimen": {"length": length(draw, 0.15, 0.35), "height": length(draw, 0.04, 0.1)},
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
            "unit_length": length(draw, 0.18, 0.3),
            "divisions": [int(2 * draw.integers(1, 3)), int(draw.integers(1, 3))],
        },
        "contact": {"unit_unit": joint},
        "drive": {"displacement": length(draw, 1e-4, 5e-4), "accuracy": float(draw.choice([0.01, 0.02, 0.05]))},
    }


def _column(draw: Draw) -> dict[str, Any]:
    return {
        "base": "column-pushed",
        "specimen": {
            "drums": int(draw.integers(2, 5)),
            "height": length(draw, 1.5, 3.5),
            "sides": int(draw.choice([4, 6, 8, 12])),
        },
        "contact": {"unit_unit": {"tan_friction_angle": float(draw.uniform(0.5, 0.8))}},
        "drive": {"displacement": length(draw, 4e-3, 2e-2), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def _tilted_wall(draw: Draw) -> dict[str, Any]:
    return {
        "base": "wall-tilted",
        "specimen": {
            "courses": int(draw.integers(3, 7)),
            "units_per_course": int(draw.integers(2, 5)),
            "unit_length": length(draw, 0.25, 0.5),
        },
        "contact": {"unit_unit": {"tan_friction_angle": float(draw.uniform(0.5, 0.8))}},
    }


def _tied_wall(draw: Draw) -> dict[str, Any]:
    return {
        "base": "wall-tied",
        "specimen": {"length": "1.8 m", "height": "1.8 m", "thickness": length(draw, 0.25, 0.4)},
        "bar": [
            {
                "ends": [["0.6 m", "0.15 m", "1.65 m"], ["0.6 m", "2.15 m", "1.65 m"]],
                "fixed_end": "second",
                "area": "1.13 cm^2",
                "young_modulus": "210 GPa",
                "strength": stress(draw, 5.0, 25.0),
                "repeat": 2,
                "spacing": ["0.6 m", "0 m", "0 m"],
            }
        ],
        "limit": {"accuracy": float(draw.choice([0.005, 0.02]))},
    }


def _prism(draw: Draw) -> dict[str, Any]:
    return {
        "base": "prism-in-compression",
        "specimen": {"length": length(draw, 0.15, 0.25)},
        "drive": {"displacement": length(draw, 8e-4, 1.4e-3), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def _arch(draw: Draw) -> dict[str, Any]:
    return {
        "base": "arch-spread",
        "specimen": {
            "voussoirs": int(draw.integers(5, 14)),
            "angle": f"{draw.uniform(110, 180):.4g} deg",
            "thickness": length(draw, 0.13, 0.25),
            "points_per_edge": int(draw.integers(2, 4)),
        },
        "drive": {"history": [f"-{draw.uniform(0.2, 2.0):.4g} mm"]},
    }


def _crushing_wall(draw: Draw) -> dict[str, Any]:
    return {
        "base": "shear-wall-size",
        "confinement": stress(draw, 0.3, 1.2),
        "specimen": {
            "courses": int(draw.integers(3, 6)),
            "units_per_course": int(draw.integers(2, 4)),
            "divisions": [1, 1],
            "points_per_edge": {"x": int(draw.integers(4, 9)), "z": 3},
        },
        "drive": {"displacement": length(draw, 2e-3, 6e-3), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def _affine(draw: Draw) -> dict[str, Any]:
    return _wallette(draw) | {"kinematics": {"default": "affine", "plates": "rigid"}}


def _tets(draw: Draw) -> dict[str, Any]:
    scene = _couplet(draw) | {"kinematics": "tets"}
    scene["specimen"] |= {"mesh_size": length(draw, 0.02, 0.05)}
    scene["support"] = [{"on": "bottom.z-", "fix": ["x", "y", "z"]}, {"on": "top", "fix": ["y"]}]
    scene["drive"] = {"on": "top.z+", "direction": "x", "displacement": length(draw, 5e-5, 2e-4)}
    return scene


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
    "shaken glued column": glued_column,
    "dry triplet in large displacement": _large,
    "wall with a window": wall_with_window,
    "wallette that is bent": bent_wallette,
    "dry wall that rocks": rocking_wall,
    "wallette to and fro": wallette_to_and_fro,
    "wall to and fro": wall_to_and_fro,
    "arch under an axle": arch_under_axle,
    "wall pushed across its plane": wall_pushed_forwards,
    "tilted dry wall in large displacement": large_tilted_wall,
    "shaken block that slides": sliding_block,
    "block that rocks": rocking_block,
    "frequencies of a wall": standing_wall,
}


OF = {"frequencies of a wall": frequency_keys(3)}
"""Numbers that are asked of a kind; where none is named, those of its run."""


def scene_of(kind: str, seed: int) -> Scene:
    """The scene of a kind and a seed."""
    draw = np.random.default_rng([seed, list(KINDS).index(kind)])
    return load({**KINDS[kind](draw), "name": f"{kind.replace(' ', '-')}-{seed}"})
