"""The energy balance of every run of this report: one sum that must close, and two sums that must agree."""

from collections.abc import Callable

from verification import timed_run
from verification.html import page
from verification.scene_runs import SceneRun

ORDER = 90
CLOSES, AGREES, TOLERABLE, FAST = 1e-9, 1e-3, 1e-2, 0.05
QUIET, SUDDEN, ROUGH, BEYOND = "quasi-static", "brittle", "too fast", "beyond the bound"
"""Sorts of runs: by their own word, by their contacts, by their kinetic energy, by their time step."""


def chapter(tell: Callable[[str], None], quick: bool = False) -> page.Chapter:
    """The worst figures by scene, over all the runs that were not stopped. Comes last: it looks at all the others, as
    many as there are.
    """
    made = page.Chapter("Energy balance")
    sorts: dict[str, list[SceneRun]] = {sort: [] for sort in (QUIET, SUDDEN, ROUGH, BEYOND)}
    for run in timed_run.DONE.values():
        if run.ok:
            sorts[sort_of(run)].append(run)
    rows, worst = [], dict.fromkeys(FIGURES, 0.0)
    for case in sorted({run.name for run in sorts[QUIET]}):
        runs = [run for run in sorts[QUIET] if run.name == case]
        tell(f"energy balance: {case}, {len(runs)} runs")
        cells: list[str | int | page.TableCell] = [case, len(runs)]
        for key, (limit, figure) in FIGURES.items():
            highest = max(runs, key=figure)
            value = figure(highest)
            worst[key] = max(worst[key], value)
            made.records.append(timed_run.record(highest, key, value, 0.0, "identity", 1.0))
            knobs = ", ".join(f"{k} = {v}" for k, v in highest.knobs.items()) or "as shipped"
            cells.append(page.judged(f"{value:.1e}", kind_of(value, limit), f"at {knobs}"))
        rows.append(cells)
    rough, step = (max(map(mismatch, sorts[sort]), default=0.0) for sort in (ROUGH, SUDDEN))
    caught = [run for run in sorts[BEYOND] if mismatch(run) > AGREES]
    made.add(
        INTRODUCTION,
        page.table(["scene", "runs", *HEADER], rows),
        f"Besides, {len(sorts[ROUGH])} runs were driven too fast to be quasi-static, and say so; there the two sums "
        f"part by up to {page.percent(rough)}. In {len(sorts[SUDDEN])} runs of brittle contacts they part by up to "
        f"{page.percent(step)}.",
        f"And {len(sorts[BEYOND])} runs took a time step beyond the proven bound and were not stopped; in "
        f"{len(caught)} of them the two sums part by more than {page.percent(AGREES)}, which gives the unstable step "
        "away.",
    )
    closes, agrees = worst.values()
    made.judge(
        "Energy balance",
        kind_of(agrees, AGREES) if closes <= CLOSES else "bad",
        f"Closes within {closes:.0e} of the external work in every run; fracture and friction summed in two ways agree "
        f"within {page.percent(agrees)} in those that are quasi-static.",
    )
    return made


def mismatch(run: SceneRun) -> float:
    """Of the two sums of what is dissipated, over the first."""
    return float(run.summary["dissipation_mismatch"])


FIGURES = {"energy_imbalance": (CLOSES, lambda run: run.imbalance), "dissipation_mismatch": (AGREES, mismatch)}
"""Key of a record -> limit, and what is measured of a run."""


def kind_of(value: float, limit: float) -> str:
    """Within the limit; or beyond it in a rough run, by less than TOLERABLE, which only the second figure may be."""
    return "ok" if value <= limit else "warn" if limit == AGREES and value <= TOLERABLE else "bad"


def sort_of(run: SceneRun) -> str:
    """Of a run that came through: what its two sums can be asked to agree to."""
    summary = run.summary
    if float(summary["step_fraction"]) > 1.0:
        return BEYOND
    if (summary["kinetic_over_internal_max"] or 0.0) > FAST:
        return ROUGH
    return SUDDEN if "brittle" in summary["law_by_group"].values() else QUIET


HEADER = ("imbalance / external work (limit 1e-9)", "dissipation, two sums (limit 1e-3)")
INTRODUCTION = (
    "The external work must equal what is stored, dissipated, damped and in motion. Fracture and friction are also "
    "added up a second time, from the laws' own state, and compared with the contacts' work less what they still hold: "
    "so the balance cannot close merely by definition. Both figures are the worst of all runs in this report that are "
    "quasi-static by their own word: with a time step within the proven bound, and kinetic energy below 5 % of the "
    "internal. Brittle contacts are looked at apart: they drop within one step, and the two sums part by what that "
    "step moves."
)
