"""Where the energy goes: rigid blocks, affine blocks and tets in one wall, with each law and each option of the laws.

    external work = kinetic + elastic + damping + work taken by the contacts            (an identity)

            4 -> u         five blocks in running bond, 0 and 1 held: 0 rigid, 1 and 3 tets, 2 and 4 affine;
          2    3           weight, tractions on 3 and 4
        0    1

Reference: by hand, the sum of v(n+1/2) - v(n-1/2) = F dt/m times v.
"""

from verification.case import Case, Findings
from verification.cases.specimens.energy_identity import SCENE, finer
from verification.checks.ledgers import identity, two_sums
from verification.scene_runs import result_of

ALL_KINDS = "energy-of-all-kinds"
OPTIONS = {
    "unloading": "elastic",
    "softening_variable": "plastic",
    "coupling": "independent",
    "dilation_angle": "5 deg",
}

EXPECTED = 1e-3
"""Difference of the two sums of the dissipation at the finer step, over the first."""


def run() -> Findings:
    """All kinds with the exponential law; rigid blocks with the others, with each option, and without damping."""
    findings = Findings()
    identity(findings, "all kinds, exponential", result_of(ALL_KINDS))
    for law in ("brittle", "linear", "polynomial"):
        identity(findings, f"rigid, {law}", result_of(SCENE, {"law": law}), ("elastic_blocks",))
    for key, value in OPTIONS.items():
        result = result_of(SCENE, {f"contact.unit_unit.{key}": value})
        identity(findings, f'rigid, exponential, {key} = "{value}"', result, ("elastic_blocks",))
    runs = [result_of(SCENE, finer(times, masses="real", damping=0.0)) for times in (2, 4)]
    identity(findings, "rigid, no damping", runs[0], ("elastic_blocks", "damping"))
    findings.note("rigid, no damping, half the step", runs[1])
    two_sums(findings, "rigid, no damping", runs, EXPECTED)
    return findings


CASE = Case(
    "energy-identity-of-all-kinds",
    "A21",
    "Where the energy goes: all kinds, laws and options",
    area="Dynamics",
    run=run,
    scene=ALL_KINDS,
    no_problems="an identity: it holds at any setting",
)
