"""A dry block on another, tipped by a drive at its middle: what it bears at the end has a closed form."""

from typing import Any

LENGTH, WIDTH, HEIGHT, DENSITY, STIFFNESS, WAY = 0.1, 0.2, 0.3, 2000.0, 30e9, 2e-4
TIPPED: dict[str, Any] = {
    "name": "tipped",
    "law": "friction",
    "kinematics": "rigid",
    "specimen": {
        "kind": "prism",
        "units": 2,
        "length": f"{LENGTH} m",
        "width": f"{WIDTH} m",
        "height": f"{HEIGHT} m",
        "points_per_edge": 3,
    },
    "material": {"units": {"density": f"{DENSITY} kg/m^3"}},
    "contact": {
        "unit_unit": {
            "normal_stiffness": f"{STIFFNESS} Pa/m",
            "shear_stiffness": "12 GPa/m",
            "tan_friction_angle": 0.9,
        }
    },
    "support": [{"on": "bottom", "fix": "all"}],
    "gravity": {"z": "-9.81 m/s^2"},
    "settle": {"steps": 2000},
    "drive": {"on": "top", "direction": "x", "displacement": f"{WAY} m", "accuracy": 0.01},
}


def borne() -> float:
    """Pa over its section. The block stands on a strip beside its edge, which closes in proportion to the distance from
    where it begins: of width a = sqrt(2 W / (kn turn width)), its resultant a third of that from the edge."""
    weight = LENGTH * WIDTH * HEIGHT * DENSITY * 9.81
    turn = WAY / (0.5 * HEIGHT)
    strip = (2.0 * weight / (STIFFNESS * turn * WIDTH)) ** 0.5
    return weight * (0.5 * LENGTH - strip / 3.0) / (0.5 * HEIGHT) / (LENGTH * WIDTH)
