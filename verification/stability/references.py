"""References for the runs of the maps: closed forms of the sheared and of the torn joint."""

import math

from verification.references import closed_forms
from verification.scene_runs import SceneRun, joint_of, load
from verification.stability.cells import Exact


def sheared(one: SceneRun) -> dict[str, Exact]:
    """Peak stress, and energy dissipated over the work done, of a joint under a constant compression."""
    loaded = load(one.scene, one.knobs)
    assert loaded.drive is not None
    law, joint = loaded.contact["unit_unit"].law, joint_of(one.scene, one.knobs)
    area = one.summary["section_m2"]
    sigma = pressure(one, area)
    slip = loaded.drive.farthest
    at_peak = min(slip, float(joint.peak(sigma)) / joint.ks)
    peak = float(closed_forms.shear(law, joint, at_peak, sigma))
    work = float(closed_forms.shear_work(law, joint, slip, sigma))
    dissipated = float(closed_forms.dissipated_in_shear(law, joint, slip, sigma))
    return {
        "peak": Exact(one.value("peak"), peak),
        "dissipated": Exact(one.value("dissipated"), area * dissipated, area * work),
    }


def sheared_over_plastic_slip(one: SceneRun) -> dict[str, Exact]:
    """As `sheared`, for the exponential law over the plastic slip p: tau = residual + (peak - residual) e^(-c0 p/G).

    The slip of the drive is tau/ks + p; the energy is the integral of tau dp.
    """
    from scipy.optimize import brentq

    loaded = load(one.scene, one.knobs)
    assert loaded.drive is not None and loaded.contact["unit_unit"].law == "exponential"
    joint, area = joint_of(one.scene, one.knobs), one.summary["section_m2"]
    sigma, slip = pressure(one, area), loaded.drive.farthest
    energy, residual = float(joint.mode_2_energy(sigma)), float(joint.residual(sigma))
    drop = float(joint.peak(sigma)) - residual

    def stress(plastic: float) -> float:
        return residual + drop * math.exp(-joint.c0 * plastic / energy)

    plastic = float(brentq(lambda p: stress(p) / joint.ks + p - slip, 0.0, slip))
    dissipated = residual * plastic - drop * energy / joint.c0 * math.expm1(-joint.c0 * plastic / energy)
    work = dissipated + 0.5 * stress(plastic) ** 2 / joint.ks
    return {
        "peak": Exact(one.value("peak"), residual + drop),
        "dissipated": Exact(one.value("dissipated"), area * dissipated, area * work),
    }


def pressure(one: SceneRun, area: float) -> float:
    """Compression (Pa) of the joint: the dead load on the top over the joint's area."""
    loaded = load(one.scene, one.knobs)
    top = area if loaded.specimen.kind != "boxes" else float(loaded.specimen.box[1].size[0]) ** 2
    return -float(loaded.traction[0].stress.z) * top / area


def torn(one: SceneRun) -> dict[str, Exact]:
    """Peak force and dissipated energy of blocks pulled apart at one joint; the drive carries the top's weight too.

    Held for openings at which next to nothing of the strength is left, so that other joints matter no more.
    """
    loaded = load(one.scene, one.knobs)
    assert loaded.drive is not None and loaded.specimen.kind == "boxes"
    law, joint = loaded.contact["unit_unit"].law, joint_of(one.scene, one.knobs)
    area = one.summary["section_m2"]
    opened = loaded.drive.farthest
    peak = float(closed_forms.tension(law, joint, min(opened, joint.opening_at_peak)))
    if loaded.gravity is not None:
        peak -= loaded.material["units"].density * float(loaded.gravity.z) * float(loaded.specimen.box[-1].size[2])
    work = float(closed_forms.tension_work(law, joint, opened))
    dissipated = float(closed_forms.dissipated_in_tension(law, joint, opened))
    return {
        "peak": Exact(one.value("peak"), peak),
        "dissipated": Exact(one.value("dissipated"), area * dissipated, area * work),
    }
