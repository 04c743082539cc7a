"""Beds of mortar one to four times as strong as their interfaces: which carries, and cracks, as the paper says."""

from typing import Any

from verification.html import page
from verification.paper.couplets.laws import CONFINEMENTS, words
from verification.paper.couplets.measures import Cracks, cracks, plateau
from verification.paper.couplets.mortar import CAPACITY, HIGH, LOW, SIZES, name, plateau_of_law
from verification.paper.experiment import Claim, Done, Run, claim
from verification.references.closed_forms import Joint

SHIPPED, WEAK, RATIOS = 4, 1, (1, 2, 3)
"""Strengths and energies of the bed over those of its interfaces: as shipped, in the weakest, in all that are tried."""
SHOWN = (("coarse", LOW), ("medium", HIGH))
"""The two models of Fig. 8."""
TABLE_1 = {
    "tensile_strength": (0.58, "MPa"),
    "cohesion": (0.87, "MPa"),
    "fracture_energy_mode_1": (5.8, "N/m"),
    "fracture_energy_mode_2": (58.0, "N/m"),
    "fracture_energy_mode_2_slope": (130.0, "N/m/MPa"),
}
LEAST, LED = 0.05, 0.5
"""Shares: of the section that is broken, to be a crack; of a crack that tension damaged more, to be one of tension."""
HEADER = ("bed / interfaces", "model", "peak / tests", "plateau / law", "broken: interfaces", "bed", "bed, by tension")


def bed(ratio: float) -> dict[str, Any]:
    """The keys of a bed so many times as strong as Table 1."""
    return {f"contact.within_mortar.{key}": f"{ratio * value:g} {unit}" for key, (value, unit) in TABLE_1.items()}


def label(size: str, confinement: str, ratio: int) -> str:
    """The label of a run; that of the shipped bed is the model's own."""
    own_name = name(size, confinement)
    return own_name if ratio == SHIPPED else f"{own_name}, bed {ratio} times as strong as its interfaces"


def runs(quick: bool) -> dict[str, Run]:
    """The models of Fig. 8 with every bed but the shipped one; in full both sizes at both confinements."""
    models = SHOWN if quick else [(size, c) for size in SIZES for c in (LOW, HIGH)]
    return {
        label(size, c, ratio): Run(SIZES[size], {"confinement": c, **bed(ratio)})
        for size, c in models
        for ratio in RATIOS
    }


def found(done: Done, size: str, confinement: str) -> dict[int, Cracks]:
    """Ratio -> cracks of a model."""
    return {ratio: cracks(done[label(size, confinement, ratio)]) for ratio in (*RATIOS, SHIPPED)}


def claims(done: Done) -> list[Claim]:
    """Section 4 on Fig. 8."""
    by_model = {f"{size}, {c}": found(done, size, c) for size, c in SHOWN}
    peaks = {
        f"{size}, {c}": {r: done.peak(label(size, c, r)) / float(Joint().peak(CONFINEMENTS[c])) for r in by_ratio}
        for (size, c), by_ratio in zip(SHOWN, by_model.values(), strict=True)
    }
    return [places(by_model), tensile(by_model), at_once(by_model, peaks)]


def places(by_model: dict[str, dict[int, Cracks]]) -> Claim:
    """The weakest bed cracks with its interfaces, the strongest stays whole."""
    weak, strong = ([by_ratio[r] for by_ratio in by_model.values()] for r in (WEAK, SHIPPED))
    return claim("Depending on the properties, the failure may occur at the interface, in the mortar joint, or in both",
                 "4, Fig. 8",
                 f"broken share of the section > {LEAST:.0%} at the interfaces of every bed; within the bed with "
                 f"{WEAK} times the strength of the interfaces, and not with {SHIPPED} times",
                 f"broken within beds {words((*RATIOS, SHIPPED), 'd')} times as strong: "
                 + "; ".join(f"{model} {words((c.bed for c in by.values()), '.2f')}" for model, by in by_model.items()),
                 all(c.bed > LEAST for c in weak) and all(c.bed <= LEAST for c in strong)
                 and all(c.lower + c.upper > LEAST for by in by_model.values() for c in by.values()),
                 "the place of failure does not follow the strengths")  # fmt: skip


def tensile(by_model: dict[str, dict[int, Cracks]]) -> Claim:
    """Tension leads within a bed that cracks."""
    led = [c for by_ratio in by_model.values() for c in by_ratio.values() if c.bed > LEAST]
    return claim("The meso-model captures tensile cracks in the mortar joint", "4",
                 f"tension damaged more than shear on over {LED:.0%} of the broken area within each bed that cracks",
                 f"{len(led)} of {sum(map(len, by_model.values()))} beds crack; led by tension: "
                 + (", ".join(f"{c.bed_tension:.0%}" for c in led) or "none"),
                 bool(led) and all(c.bed_tension > LED for c in led), "shear did more, or no bed cracks")  # fmt: skip


def at_once(by_model: dict[str, dict[int, Cracks]], peaks: dict[str, dict[int, float]]) -> Claim:
    """Whether one bed gives both the capacity and the cracks of Fig. 8."""
    both = [
        ratio
        for ratio in (*RATIOS, SHIPPED)
        if all(by_model[m][ratio].bed > LEAST and abs(peaks[m][ratio] - 1.0) <= CAPACITY for m in by_model)
    ]
    return claim("Fairly close responses together with realistic failure modes", "4, Fig. 8",
                 f"one of the beds gives peaks within {CAPACITY:.0%} of the tests and cracks within the mortar, in "
                 "both models",
                 f"peak over that of the tests with {words((*RATIOS, SHIPPED), 'd')} times the strength: "
                 + "; ".join(f"{model} {words(by.values(), '.2f')}" for model, by in peaks.items()),
                 bool(both), "a bed as weak as its interfaces cracks, and carries a tenth to a sixth too "
                 "little; from twice their strength on it carries enough and stays whole. Table 2, which "
                 "had both, is lost")  # fmt: skip


def parts(done: Done) -> list[str]:
    """The table of beds."""
    rows = []
    for size, c in SHOWN if done.quick else [(size, c) for size in SIZES for c in (LOW, HIGH)]:
        for ratio, crack in found(done, size, c).items():
            run = done[label(size, c, ratio)]
            peak = run.summary["peak_stress_pa"] / float(Joint().peak(CONFINEMENTS[c]))
            level = plateau(run.history.rows) / plateau_of_law(run.history.rows, CONFINEMENTS[c])
            fractions = (crack.lower + crack.upper, crack.bed, crack.bed_tension)
            rows.append([f"{ratio}", f"{size}, {c}", f"{peak:.3f}", f"{level:.2f}", *(f"{v:.2f}" for v in fractions)])
    return [page.table(HEADER, rows, "The bed's strengths and energies over those of its interfaces (4 is shipped)")]
