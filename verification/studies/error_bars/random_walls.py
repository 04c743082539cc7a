"""Random scenes of walls: with an opening, bent, in large displacement, in cycles, under loads that grow."""

from typing import Any

from verification.studies.error_bars.draws import LAWS, Draw, length, stress


def _mortar(strength: float, cohesion: float, friction: float, energy: int) -> dict[str, Any]:
    """A joint: tensile strength and cohesion (MPa), friction, energy of fracture in mode 1 (N/m), a fifth of mode 2."""
    return {
        "normal_stiffness": "60 GPa/m",
        "shear_stiffness": "25 GPa/m",
        "tensile_strength": f"{strength:.4g} MPa",
        "cohesion": f"{cohesion:.4g} MPa",
        "tan_friction_angle": friction,
        "fracture_energy_mode_1": f"{energy} N/m",
        "fracture_energy_mode_2": f"{5 * energy} N/m",
    }


def wall_with_window(draw: Draw) -> dict[str, Any]:
    """Mortared, with a window below a lintel; the beam above is pushed."""
    strength = draw.uniform(0.05, 0.3)
    cohesion, friction = strength * draw.uniform(1.2, 2.0), float(draw.uniform(0.6, 0.8))
    joint = _mortar(strength, cohesion, friction, 10)
    return {
        "base": "wall-with-window",
        "law": str(draw.choice(LAWS)),
        "specimen": {
            "length": "1.5 m",
            "height": "1 m",
            "unit_length": "290 mm",
            "unit_height": "190 mm",
            "contact_points": "gauss",
            "opening": [
                {
                    "name": "window",
                    "left": str(draw.choice(["300 mm", "450 mm"])),
                    "sill": str(draw.choice(["200 mm", "400 mm"])),
                    "width": str(draw.choice(["450 mm", "600 mm"])),
                    "height": "400 mm",
                    "head_courses": 1,
                }
            ],
        },
        "contact": {"unit_unit": joint, "lintels_units": joint, "plate": joint},
        "traction": [{"on": "beam.z+", "stress": {"z": f"-{stress(draw, 0.05, 0.5)}"}}],
        "drive": {"displacement": length(draw, 5e-4, 2e-3), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def bent_wallette(draw: Draw) -> dict[str, Any]:
    """Between four rollers, out of its plane."""
    strength = draw.uniform(0.1, 0.4)
    return {
        "base": "bending-0",
        "law": str(draw.choice(LAWS)),
        "specimen": {
            "courses": int(draw.integers(2, 4)),
            "units_per_course": int(draw.integers(2, 4)),
            "thickness": length(draw, 0.08, 0.14),
            "divisions": [2, 1, 1],
            "points_per_edge": {"x": 2, "y": int(draw.integers(3, 9)), "z": 2},
        },
        "contact": {
            "unit_unit": {
                "tensile_strength": f"{strength:.4g} MPa",
                "cohesion": f"{strength * draw.uniform(1.2, 2.0):.4g} MPa",
            }
        },
        "drive": {"displacement": length(draw, 1e-4, 4e-4), "accuracy": float(draw.choice([0.01, 0.03]))},
    }


def rocking_wall(draw: Draw) -> dict[str, Any]:
    """Dry, under a load that stays in place; its beam is pushed in large displacement."""
    return {
        "base": "wall-ws100",
        "specimen": {
            "courses": int(draw.integers(2, 5)),
            "units_per_course": int(draw.integers(2, 4)),
            "patch_points_per_edge": int(2 * draw.integers(1, 4)),
        },
        "traction": [
            {"on": "beam.z+", "stress": {"z": f"-{stress(draw, 0.1, 0.8)}"}, "line_of_action": "fixed"},
        ],
        "drive": {"displacement": length(draw, 4e-3, 1.5e-2), "accuracy": float(draw.choice([0.02, 0.05]))},
    }


def wallette_to_and_fro(draw: Draw) -> dict[str, Any]:
    """Pulled and pushed along its bed joints, further the second time."""
    strength, way = draw.uniform(0.05, 0.4), draw.uniform(2e-5, 2e-4, 2)
    return {
        "base": "wallette-cyclic",
        "law": str(draw.choice(LAWS)),
        "specimen": {
            "courses": int(draw.integers(2, 4)),
            "units_per_course": int(draw.integers(1, 3)),
            "divisions": [2, 1],
        },
        "contact": {
            "unit_unit": {
                "tensile_strength": f"{strength:.4g} MPa",
                "cohesion": f"{strength * draw.uniform(1.2, 2.0):.4g} MPa",
            }
        },
        "drive": {
            "history": [f"{1e3 * u:.4g} mm" for u in (min(way), -1e-5, max(way), 0.0)],
            "accuracy": float(draw.choice([0.01, 0.03])),
        },
    }


def wall_to_and_fro(draw: Draw) -> dict[str, Any]:
    """Under a level beam, sheared to and fro; its toes crush."""
    way = draw.uniform(5e-4, 3e-3, 2)
    return {
        "base": "shear-wall-size",
        "confinement": stress(draw, 0.3, 1.2),
        "specimen": {
            "courses": int(draw.integers(2, 5)),
            "units_per_course": int(draw.integers(2, 4)),
            "divisions": [1, 1],
            "points_per_edge": {"x": int(draw.integers(4, 9)), "z": 3},
        },
        "drive": {
            "history": [f"{1e3 * sign * u:.4g} mm" for sign, u in zip((1, -1), sorted(way), strict=True)],
            "accuracy": float(draw.choice([0.01, 0.03])),
        },
    }


def arch_under_axle(draw: Draw) -> dict[str, Any]:
    """A dry bridge of one span whose axle grows until it falls."""
    return {
        "base": "bridge-single-span",
        "specimen": {
            "rise": length(draw, 0.9, 1.6),
            "thickness": length(draw, 0.3, 0.5),
            "voussoirs": int(draw.integers(6, 13)),
            "points_per_edge": int(draw.integers(2, 4)),
        },
        "vehicle": {"position": length(draw, 1.0, 2.4)},
        "settle": {"steps": 8000},
        "limit": {"accuracy": float(draw.choice([0.01, 0.03]))},
    }


def wall_pushed_forwards(draw: Draw) -> dict[str, Any]:
    """A mortared wall under a pressure across its plane that grows until it falls."""
    strength = draw.uniform(0.02, 0.1)
    joint = _mortar(strength, strength * draw.uniform(1.2, 2.0), 0.7, 8)
    return {
        "name": "wall",
        "law": str(draw.choice(LAWS)),
        "specimen": {
            "kind": "wallette",
            "courses": int(draw.integers(2, 5)),
            "units_per_course": int(draw.integers(1, 3)),
            "unit_length": "290 mm",
            "unit_height": "190 mm",
            "thickness": length(draw, 0.1, 0.2),
            "joint_thickness": "10 mm",
            "base": "100 mm",
            "points_per_edge": {"x": 2, "y": int(draw.integers(3, 7)), "z": 2},
        },
        "material": {"units": {"density": "1900 kg/m^3"}, "plates": {"density": "2400 kg/m^3"}},
        "contact": {"unit_unit": joint, "plate": joint},
        "support": [{"on": "base", "fix": "all"}],
        "gravity": {"z": "-9.81 m/s^2"},
        "settle": {"steps": 4000},
        "limit": {
            "pattern": "weight",
            "direction": "y",
            "accuracy": float(draw.choice([0.01, 0.03])),
        },
    }


def large_tilted_wall(draw: Draw) -> dict[str, Any]:
    """Dry, in large displacement, tilted until it falls."""
    return {
        "base": "wall-tilted",
        "displacements": "large",
        "specimen": {
            "courses": int(draw.integers(3, 5)),
            "units_per_course": int(draw.integers(2, 4)),
            "unit_length": length(draw, 0.25, 0.5),
            "patch_points_per_edge": int(2 * draw.integers(1, 4)),
        },
        "contact": {"unit_unit": {"tan_friction_angle": float(draw.uniform(0.5, 0.8))}},
        "limit": {"accuracy": float(draw.choice([0.01, 0.03]))},
    }


def standing_wall(draw: Draw) -> dict[str, Any]:
    """Glued, on a base that stands still; of rigid or affine blocks, or of tets."""
    kinematics = str(draw.choice(["rigid", "affine", "tets"]))
    joint = {
        "normal_stiffness": f"{draw.uniform(5.0, 80.0):.4g} GPa/m",
        "shear_stiffness": f"{draw.uniform(2.0, 30.0):.4g} GPa/m",
    }
    return {
        "name": "wall",
        "law": "elastic",
        "kinematics": {"default": kinematics, "plates": "rigid"},
        "specimen": {
            "kind": "wallette",
            "courses": int(draw.integers(2, 6)),
            "units_per_course": int(draw.integers(1, 4)),
            "unit_length": length(draw, 0.2, 0.4),
            "unit_height": length(draw, 0.1, 0.2),
            "thickness": length(draw, 0.1, 0.2),
            "base": "100 mm",
            "points_per_edge": int(draw.integers(2, 4)),
        }
        | (
            {"mesh_size": "150 mm"}
            if kinematics == "tets"
            else {"contact_points": str(draw.choice(["gauss", "vertex"]))}
        ),
        "material": {
            "units": {"density": "1900 kg/m^3", "young_modulus": "5 GPa", "poisson_ratio": 0.2},
            "plates": {"density": "2400 kg/m^3"},
        },
        "contact": {"unit_unit": joint, "plate": joint},
        "support": [{"on": "base", "fix": "all"}],
        "gravity": {"z": "-9.81 m/s^2"},
    }
