"""Mortared walls and blocks whose joints bend, slide, or both; and what a run says of their contact points."""

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from masonry.judgement.doubt import Doubt
from masonry.judgement.judgement import judgement_of
from verification.fixtures.dry_blocks import box
from verification.stability.scenes import Knobs

WALL, BLOCK = "mortared-wall", "block-bent-at-its-bed"
ENOUGH = 12
"""Gauss points along the edges that bend, with which the strength is converged within 1 %."""
TURNS, LEVEL = ["y", "rotation x", "rotation z"], ["y", "rotation"]
MORTAR = {
    "normal_stiffness": "80 GPa/m",
    "shear_stiffness": "35 GPa/m",
    "tensile_strength": "0.15 MPa",
    "cohesion": "0.22 MPa",
    "tan_friction_angle": 0.7,
    "tan_residual_friction_angle": 0.6,
    "fracture_energy_mode_1": "10 N/m",
    "fracture_energy_mode_2": "50 N/m",
}
"""As the scene of the wall has it."""
WEAK = {"tensile_strength": "0.05 MPa", "cohesion": "0.08 MPa", "fracture_energy_mode_1": "3 N/m"}
THROUGH = "y"
"""The direction across the joints of walls that bend out of their plane."""


class MortaredWall(NamedTuple):
    """A scene, what is set anew in it, and the direction in which points along edges count where its joints bend."""

    scene: str
    knobs: Knobs
    bends: str = "x"

    def with_points(self, rule: str, number: int) -> Knobs:
        """All its knobs, with so many contact points along the edges that bend, and two along the others."""
        numbers = {"x": 2, "y": number, "z": 2} if self.bends == THROUGH else {"x": number, "y": 2, "z": number}
        return {**self.knobs, "specimen.contact_points": rule, "specimen.points_per_edge": numbers}


def walls() -> dict[str, MortaredWall]:
    """Twelve of them."""
    window = {"name": "window", "left": "0.5 m", "sill": "0.5 m", "width": "0.5 m", "height": "0.75 m"}
    door = {"name": "door", "left": "2 m", "width": "0.5 m", "height": "1.25 m"}
    facade = {"specimen.length": "3 m", "specimen.height": "1.75 m", "specimen.opening": [window, door]}
    weight = {"gravity": {"z": "-9.81 m/s^2"}, "traction": []}
    return {
        "wall with a door": MortaredWall(WALL, {}),
        "facade, 0.3 MPa": MortaredWall(WALL, {**facade, "confinement": "0.3 MPa"}),
        "facade, own weight": MortaredWall(WALL, {**facade, **weight, "support.1.fix": TURNS}),
        "squat wall, 0.5 MPa": MortaredWall(WALL, _solid("2 m", "1 m", "0.5 MPa")),
        "weak mortar": MortaredWall(WALL, _solid("1.5 m", "1.5 m", "0.2 MPa", **WEAK)),
        "slender pier": MortaredWall(
            WALL, _solid("0.5 m", "1.5 m", "0.2 MPa", "0.25 m") | {"support.1.fix": TURNS, "drive.displacement": "2 mm"}
        ),
        "pier under a level beam": MortaredWall(WALL, _solid("0.5 m", "1 m", "0.4 MPa", "0.25 m")),
        "cantilever out of plane": MortaredWall(BLOCK, _stack(6) | weight | {"support.1": _hold("b5", ["x"])}, THROUGH),
        "strip, pushed at its middle": MortaredWall(
            BLOCK,
            _stack(7)
            | {"support.1": _hold("b6", ["x", "y", "rotation"]), "drive.on": "b3", "drive.displacement": "1 mm"}
            | {"traction.0.on": "b6.z+", "traction.0.stress": {"z": "-0.2 MPa"}},
            THROUGH,
        ),
        "block, brittle mortar": MortaredWall(BLOCK, {"contact.unit_unit.fracture_energy_mode_1": "1 N/m"}),
        "block, tough mortar": MortaredWall(BLOCK, {"contact.unit_unit.fracture_energy_mode_1": "50 N/m"}),
        "block, pressed": MortaredWall(BLOCK, {"traction.0.stress": {"z": "-0.3 MPa"}}),
    }


def said(summary: Mapping[str, Any]) -> float:
    """The factor by which the run says that its strength is off for its contact points; 1 where it is silent."""
    doubt = few_points(summary)
    return 1.0 if doubt is None or doubt.value is None else 1.0 + doubt.value


def proposed(summary: Mapping[str, Any]) -> int:
    """The number of points along edges that the run proposes; 0 where it is silent."""
    doubt = few_points(summary)
    words = None if doubt is None else re.search(r"take specimen.points_per_edge = (\d+)", doubt.advice)
    return int(words[1]) if words else 0


def few_points(summary: Mapping[str, Any]) -> Doubt | None:
    """Doubt of a run about the number of its contact points; None where it is silent."""
    return next((doubt for doubt in judgement_of(summary).doubts if doubt.name == "few_points"), None)


def _solid(length: str, height: str, pressure: str, unit: str = "0.5 m", **mortar: str) -> Knobs:
    """Without openings, and so without lintels."""
    shape = {"specimen.length": length, "specimen.height": height, "specimen.unit_length": unit}
    density = {"density": "2000 kg/m^3"}
    groups: Knobs = {"specimen.opening": [], "material": {"units": density, "plates": density}}
    contact = {"contact": {group: {**MORTAR, **mortar} for group in ("unit_unit", "plate")}}
    return shape | groups | contact | {"confinement": pressure}


def _stack(courses: int) -> Knobs:
    """A strip of wall, half a metre long, that is pushed across at its top."""
    blocks = [box("ground", (0.0, 0.0, -0.1), (0.5, 0.2, 0.1), 0)]
    blocks += [box(f"b{k}", (0.0, 0.0, 0.25 * k), (0.5, 0.2, 0.25), k + 1) for k in range(courses)]
    pushed = {"drive.on": f"b{courses - 1}", "drive.direction": "y", "drive.displacement": "2 mm"}
    return {"specimen.box": blocks, "specimen.section": "0.1 m^2", **pushed}


def _hold(on: str, fix: list[str]) -> Knobs:
    return {"on": on, "fix": fix}
