"""The energy balance of every run of this report: one sum that must close, and two sums that must agree."""

from collections.abc import Callable

from verification import timed_run
from verification.html import page
from verification.scene_runs import Run

ORDER = 90
CLOSES, AGREES, TOLERABLE, FAST = 1e-9, 1e-3, 1e-2, 0.05
QUIET, SUDDEN, ROUGH, BEYOND = "quasi-static", "brittle", "too fast", "beyond the bound"
"""Sorts of runs: by their own word, by their contacts, by their kinetic energy, by their time step."""


def chapter(tell: Callable[[str], None]) -> page.Chapter:
    """The worst figures by scene, over all the runs that were not stopped. Comes last: it looks at all the others."""
    made = page.Chapter("Energy balance")
    made.parts.append(
        page.paragraph(
            "The external work must equal what is stored, dissipated, damped and in motion. Fracture and friction are "
            "also added up a second time, from the laws' own state, and compared with the contacts' work less what "
            "they still hold: so the balance cannot close merely by definition. Both figures are the worst of all "
            "runs in this report that are quasi-static by their own word: with a time step within the proven bound, "
            "and kinetic energy below 5 % of the internal. Brittle contacts are looked at apart: they drop within one "
            "step, and the two sums part by what that step moves."
        )
    )
    rows, worst = [], {"energy_imbalance": 0.0, "dissipation_mismatch": 0.0}
    sorts: dict[str, list[Run]] = {sort: [] for sort in (QUIET, SUDDEN, ROUGH, BEYOND)}
    for one in timed_run.DONE.values():
        if one.ok:
            sorts[sort_of(one)].append(one)
    for case in sorted({t.name for t in sorts[QUIET]}):
        runs = [t for t in sorts[QUIET] if t.name == case]
        tell(f"energy balance: {case}, {len(runs)} runs")
        cells: list[str | int | page.Cell] = [case, len(runs)]
        for key, limit in (("energy_imbalance", CLOSES), ("dissipation_mismatch", AGREES)):
            highest = max(runs, key=lambda t: t.summary[key])
            value = float(highest.summary[key])
            worst[key] = max(worst[key], value)
            made.records.append(timed_run.record(highest, key, value, 0.0, "identity", 1.0))
            knobs = ", ".join(f"{k} = {v}" for k, v in highest.knobs.items()) or "as shipped"
            cells.append(page.Cell(f"{value:.1e}", kind_of(value, limit), f"at {knobs}"))
        rows.append(cells)
    header = ["scene", "runs", "imbalance / external work (limit 1e-9)", "dissipation, two sums (limit 1e-3)"]
    made.parts.append(page.table(header, rows))
    sentence = (
        f"Closes within {worst['energy_imbalance']:.0e} of the external work in every run; fracture and friction "
        f"summed in two ways agree within {page.percent(worst['dissipation_mismatch'])} in those that are quasi-static."
    )
    made.verdicts.append(
        page.Verdict(
            "Energy balance",
            kind_of(worst["dissipation_mismatch"], AGREES) if worst["energy_imbalance"] <= CLOSES else "bad",
            sentence,
        )
    )
    part, step = (
        max((float(t.summary["dissipation_mismatch"]) for t in sorts[sort]), default=0.0) for sort in (ROUGH, SUDDEN)
    )
    caught = [t for t in sorts[BEYOND] if t.summary["dissipation_mismatch"] > AGREES]
    made.parts.append(
        page.paragraph(
            f"Besides, {len(sorts[ROUGH])} runs were driven too fast to be quasi-static, and say so; there the two "
            f"sums part by up to {page.percent(part)}. In {len(sorts[SUDDEN])} runs of brittle contacts they part by "
            f"up to {page.percent(step)}."
        )
    )
    made.parts.append(
        page.paragraph(
            f"And {len(sorts[BEYOND])} runs took a time step beyond the proven bound and were not stopped; in "
            f"{len(caught)} of them the two sums part by more than {page.percent(AGREES)}, which gives the "
            "unstable step away."
        )
    )
    return made


def kind_of(value: float, limit: float) -> str:
    """Within the limit; or beyond it in a rough run, by less than TOLERABLE, which only the second figure may be."""
    return "ok" if value <= limit else "warn" if limit == AGREES and value <= TOLERABLE else "bad"


def sort_of(one: Run) -> str:
    """Of a run that came through: what its two sums can be asked to agree to."""
    summary = one.summary
    if float(summary["step_fraction"]) > 1.0:
        return BEYOND
    if float(summary["kinetic_over_internal_max"]) > FAST:
        return ROUGH
    return SUDDEN if "brittle" in summary["law_by_group"].values() else QUIET
