"""The scenes of the maps, and the knobs that put them at their limits."""

from typing import Any

from verification.fixtures.dry_blocks import box
from verification.references.closed_forms import Joint
from verification.scene_runs import joint_of

COUPLET, PAIR, CHAIN = "couplet", "pair", "chain"
JOINT = "contact.unit_unit"
WIDTHS = 8.0
"""Softening widths that a drive goes beyond the peak."""
Knobs = dict[str, Any]


def pascals(**keys: float) -> Knobs:
    """Stiffnesses (Pa/m), strengths (Pa) or energies (N/m) of the joint: `normal_stiffness=1e9`."""
    units = {"stiffness": "Pa/m", "strength": "Pa", "cohesion": "Pa", "1": "N/m", "2": "N/m", "slope": "m"}
    return {
        f"{JOINT}.{key}": f"{1e6 * x!r} N/m/MPa" if key.endswith("slope") else f"{x!r} {units[key.split('_')[-1]]}"
        for key, x in keys.items()
    }


def far_enough(law: str, joint: Joint, sigma: float) -> float:
    """Slip (m) at which a joint under a compression (Pa) has softened."""
    peak, g2 = float(joint.peak(sigma)), float(joint.mode_2_energy(sigma))
    if law == "brittle":
        return 3.0 * peak / joint.ks
    return peak / joint.ks + WIDTHS * g2 / (joint.c0 or peak)


def slid(name: str, knobs: Knobs, sigma: float = 0.5e6) -> Knobs:
    """Knobs with a drive that goes through the whole softening of the joint."""
    joint = joint_of(name, {key: value for key, value in knobs.items() if not key.startswith("drive")})
    travel = far_enough(str(knobs.get("law")), joint, sigma)
    return {
        "drive.displacement": f"{travel!r} m",
        "solver.slip_limit": 100,
        **knobs,
    }  # the law is judged, not the joint


def pair_of(low: float, top: float) -> Knobs:
    """Cubes of two sizes (m), the joint scaled with the smaller: the same curve at every size.

    Lengths of the joint (slip at the peak, width of the softening) go with the edge of the smaller cube.
    """
    edge = min(low, top)
    side = (low - top) / 2
    return {
        "specimen.box": [box("low", (0.0, 0.0, 0.0), (low,) * 3, 0), box("top", (side, side, low), (top,) * 3, 1)],
        "specimen.section": f"{edge * edge!r} m^2",
        "traction.0.stress": {"z": f"{-0.5e6 * (edge / top) ** 2!r} Pa"},
        "drive.displacement": f"{1e-3 * edge!r} m",
        **pascals(normal_stiffness=150e9 / edge, shear_stiffness=70e9 / edge),
        **pascals(fracture_energy_mode_1=5.8 * edge, fracture_energy_mode_2=58.0 * edge),
        **pascals(fracture_energy_mode_2_slope=130e-6 * edge),
    }


def chain_of(heights: tuple[float, ...]) -> Knobs:
    """Blocks of the given heights (m) one on the other, a square of 0.1 m in plan: "end", "b1", ..., "top"."""
    names = ["end", *(f"b{k}" for k in range(1, len(heights) - 1)), "top"]
    boxes, level = [], 0.0
    for k, (name, height) in enumerate(zip(names, heights, strict=True)):
        boxes.append(box(name, (0.0, 0.0, level), (0.1, 0.1, height), k))
        level += height
    return {"specimen.box": boxes, "specimen.section": "0.01 m^2"}
