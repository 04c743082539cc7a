"""Table 2 is lost: what was assumed in its place beside the bed's strength, varied, and how far the couplet moves."""

from collections.abc import Mapping
from typing import Any

from verification.html import page
from verification.paper.couplets.measures import plateau
from verification.paper.couplets.mortar import HIGH, LOW, SIZES, name
from verification.paper.experiment import Claim, Done, Run, claim

HEADER = ("bed", "assumed", "varied to", *(f"{what}, {c}" for c in (LOW, HIGH) for what in ("peak", "plateau")))


def everywhere(key: str, value: str) -> dict[str, Any]:
    """A property of the interfaces and of the bed alike."""
    return {f"contact.{group}.{key}": value for group in ("unit_mortar", "within_mortar")}


VARIED: dict[tuple[str, str, str], Mapping[str, Any]] = {
    ("coarse", "tensile strength of interfaces 0.58 MPa", "0.29 MPa"): {
        "contact.unit_mortar.tensile_strength": "0.29 MPa"
    },
    ("coarse", "tensile strength of interfaces 0.58 MPa", "0.87 MPa"): {
        "contact.unit_mortar.tensile_strength": "0.87 MPa"
    },
    ("coarse", "their energy of mode I 5.8 N/m", "2.9 N/m"): {"contact.unit_mortar.fracture_energy_mode_1": "2.9 N/m"},
    ("coarse", "their energy of mode I 5.8 N/m", "11.6 N/m"): {
        "contact.unit_mortar.fracture_energy_mode_1": "11.6 N/m"
    },
    ("coarse", "shear stiffness 302 GPa/m", "151 GPa/m"): everywhere("shear_stiffness", "151 GPa/m"),
    ("medium", "springs of E/2.49 mm, G/2.49 mm", "those of the coarse bed, 4 mm"): {
        **everywhere("normal_stiffness", "725 GPa/m"),
        **everywhere("shear_stiffness", "302 GPa/m"),
    },
}


def label(size: str, assumed: str, varied: str, confinement: str) -> str:
    """The label of a run."""
    return f"{size}, {assumed} varied to {varied}, {confinement}"


def runs() -> dict[str, Run]:
    """Each variation at the lowest and the highest confinement."""
    return {
        label(*key, c): Run(SIZES[key[0]], {"confinement": c, **knobs})
        for key, knobs in VARIED.items()
        for c in (LOW, HIGH)
    }


def moves(done: Done) -> dict[tuple[str, str, str], list[float]]:
    """Variation -> change of peak and of plateau, as shares of the peak and of the plateau, at both confinements."""
    changes: dict[tuple[str, str, str], list[float]] = {}
    for key in VARIED:
        for c in (LOW, HIGH):
            run, base = done[label(*key, c)], done[name(key[0], c)]
            peak = done.peak(label(*key, c)) / done.peak(name(key[0], c)) - 1.0
            rest = plateau(run.history.rows) / plateau(base.history.rows) - 1.0
            changes.setdefault(key, []).extend([peak, rest])
    return changes


def claims(done: Done) -> list[Claim]:
    """Effect of what Table 2 said: the values cannot be decided, but how much depends on them can."""
    if label(*next(iter(VARIED)), LOW) not in done.runs:
        return []
    changes = moves(done).values()
    peaks, rests = ([v for change in changes for v in change[k::2]] for k in (0, 1))
    return [
        claim("The identical nonlinear contact properties of Table 2 are employed in both meso-models", "4, Table 2",
              "how far the couplet moves with what is assumed instead, Table 1 at interfaces and four times that "
              "within",
              f"peaks {min(peaks):+.0%} to {max(peaks):+.0%}, plateaus {min(rests):+.0%} to {max(rests):+.0%} over "
              f"{len(VARIED)} variations at {LOW} and {HIGH}",
              None, "Table 2 is lost. How much stronger the bed is than its interfaces counts most: see the table of "
              "beds"),
    ]  # fmt: skip


def parts(done: Done) -> list[str]:
    """The table of variations."""
    if label(*next(iter(VARIED)), LOW) not in done.runs:
        return []
    rows = [[*key, *(f"{100.0 * v:+.1f} %" for v in change)] for key, change in moves(done).items()]
    return [page.table(HEADER, rows, "Changes if the lost Table 2 had other values")]
