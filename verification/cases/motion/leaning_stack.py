"""Ten blocks of which each overhangs the one below by a share f of the harmonic overhang: they stand if f < 1.

                 ____
              __|____|          overhang of block i from the top: f L/(2 i);  stands for f < 1, whatever the number
          __ |____|
         |____|__               f = 0.995 stands, f = 1.005 falls
     ====|edge

Reference: statics (the harmonic stack); at f = 1 the weight of all blocks above acts on each edge.
"""

from verification.case import Case, Findings
from verification.fixtures.dry_blocks import box
from verification.scene_runs import result_of

SCENE, COUNT, LONG, HIGH = "dry-block", 10, 0.2, 0.06
KNOBS = {
    "contact.unit_unit.tan_friction_angle": 0.7,
    "settle.steps": 60000,
    "solver.duration": "1.5 s",
    "solver.rows": 300,
}


def boxes(factor: float) -> list[dict[str, object]]:
    """The stack on a slab that ends at x = 0."""
    stack, right = [box("slab", (-1.0, -0.5, -0.1), (1.0, 1.0, 0.1), 0)], 0.0
    for level, i in enumerate(range(COUNT, 0, -1)):
        right += factor * LONG / (2 * i)
        name = "block" if i == 1 else f"block {i}"
        stack.append(box(name, (right - LONG, -0.05, level * HIGH), (LONG, 0.1, HIGH), level + 1))
    return stack


def run() -> Findings:
    """It stands at 0.995 and falls at 1.005."""
    findings = Findings()
    for factor in (0.995, 1.005):
        result = findings.note(f"f = {factor:g}", result_of(SCENE, {"specimen.box": boxes(factor), **KNOBS}))
        rotation = result.summary["rotation_max_rad"]
        if factor < 1.0:
            findings.at_most("rotation where it stands", "rad", rotation, 1e-3, "the springs give way by less")
        else:
            findings.at_most("less than the rotation where it falls", "rad", 0.02, rotation, "it turns on and on")
    return findings


CASE = Case(
    name="leaning-stack",
    row="A33",
    title="A leaning stack of ten blocks",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    no_problems="it stands or it falls",
)
