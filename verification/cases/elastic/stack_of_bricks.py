"""A stack of bricks and mortar shortens as they do, whatever its blocks are: rigid, divided, or such that deform.

        | p
      __v__     h   units, E_u             one course shortens by p (h/E_u + t/E_m)
     |_____|    t   mortar, E_m
     |_____|                               E = (h + t)/(h/E_u + t/E_m)
     |_____|        joints without
    /////////       thickness

The stiffnesses are those of `masonry.contact`, which takes off what the blocks of a model shorten themselves. A gauge
measures two courses from middle to middle. Poisson's ratio is 0, so that the held foot restrains nothing.
"""

from typing import Any

from masonry import contact
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import load, result_of

SCENE = "stack-of-bricks"
HEIGHT, JOINT, UNIT, MORTAR, PRESSURE = 0.065, 0.010, 10e9, 1.5e9, 1e6
MODULUS = (HEIGHT + JOINT) / (HEIGHT / UNIT + JOINT / MORTAR)
MODELS: dict[str, dict[str, Any]] = {
    "rigid blocks": {"kinematics": "rigid"},
    "rigid, 3 in a unit": {"specimen.divisions": [1, 1, 3]},
    "affine blocks": {"kinematics": "affine"},
    "affine, 2 in a unit": {"kinematics": "affine", "specimen.divisions": [1, 1, 2]},
}


def run() -> Findings:
    """The modulus of each model, and that which the table foretells."""
    findings = Findings()
    for words, model in MODELS.items():
        scene = load(SCENE, model)
        table = contact(scene, law="elastic", poisson=0, joint="10 mm", unit_modulus="10 GPa", mortar_modulus="1.5 GPa")
        result = findings.note(words, result_of(SCENE, {**model, **table}))
        shortening = result.summary["gauges"]["shortening"]["final_m"]
        tolerance = Tolerance(
            5e-6, 1e-6, "stiffnesses are written with six digits, which leaves half of one in the last"
        )
        findings.check(f"modulus, {words}", "Pa", PRESSURE * 2.0 * (HEIGHT + JOINT) / shortening, MODULUS, tolerance)
        tolerance = Tolerance(1e-14, 1e-15, "the same springs in a row: rounding")
        findings.check(f"modulus that the table foretells, {words}", "Pa", table.modulus, MODULUS, tolerance)
    return findings


CASE = Case(
    "stack-of-bricks",
    "A69",
    "A stack of bricks and mortar by the table of their moduli",
    area="Elastic assemblies",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="the stiffnesses follow from moduli and heights; nothing is chosen but steps until all is at rest",
)
