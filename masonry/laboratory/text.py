"""Text of the command line about a scene and about a result, aligned for a person."""

from dataclasses import dataclass
from math import atan, degrees, tan
from pathlib import Path
from typing import Any

import numpy as np

from masonry.judgement.doubts.peak_passed import still_rises
from masonry.judgement.evidence import has_drive
from masonry.judgement.sentence import advice, trust
from masonry.judgement.words import BELOW_0, number_text, percent, stress_text
from masonry.laboratory.beside_text import measured_lines, standard_lines
from masonry.laboratory.shaking_text import shaking_rows
from masonry.results.frame_choice import without_noise
from masonry.results.reaction_words import reaction_lines
from masonry.results.summary import CollapseBranch, CollapseLoad, FirstFall, LoadLoops, Readings, Shaking, Summary
from masonry.runtime.named_file import FORMATS
from masonry.runtime.progress import duration
from masonry.runtime.record import Record
from masonry.runtime.tables import Rows, aligned, html_table

NO_FORCE = "no force was measured at them"
FEW = 6
TOLD = 0.1
"""Share of the work of the drive from which on the work of a dead load is printed."""


@dataclass(frozen=True, eq=False, repr=False)
class Report(Record):
    """Report of `masonry.check` on a scene; it prints as `masonry check` does.

    contacts     number of joints by contact group
    limited_by   what bounds the time step, in words, as all that follows but for steps, seconds and warnings
    steps, expected_seconds          about; seconds are of processor, without compiling
    steps_between, seconds_between   at least and at most; twice the same where all steps are known beforehand
    error_bar    the command that refines the scene; empty where nothing can be refined
    """

    blocks: int
    cells: list[str]
    scatter: list[str]
    contacts: dict[str, int]
    contact_points: int
    tets: int
    freedoms: int
    time_step_s: float
    limited_by: str
    quality: dict[str, str]
    masses: list[str]
    bars: list[str]
    slabs: list[str]
    quiet: list[str]
    settling: str
    meeting: str
    moved: list[str]
    ratios: list[str]
    steps: int
    steps_between: tuple[int, int]
    expected_seconds: float
    seconds_between: tuple[float, float]
    left_out: list[str]
    compiled: list[str]
    warnings: list[str]
    error_bar: str = ""

    def __repr__(self) -> str:
        return check_text(self)

    def _repr_html_(self) -> str:
        return html_table("What this scene would run", check_rows(self))


def check_text(report: Report) -> str:
    """The report of `masonry.laboratory.laboratory.check` as lines."""
    return aligned(check_rows(report))


def check_rows(report: Report) -> Rows:
    """The same, row by row."""
    longest = max((len(name) for name in report.contacts), default=0)
    rows = [
        ("blocks", [f"{report.blocks}"]),
        ("cells", report.cells),
        ("contacts", [f"{name:<{longest}}  {number}" for name, number in report.contacts.items()] or ["none"]),
        ("scatter", report.scatter),
        ("contact points", [f"{report.contact_points}"]),
        ("tets", [f"{report.tets}"]),
        ("degrees of freedom", [f"{report.freedoms}"]),
        ("time step", [f"{report.time_step_s:.4g} s, limited by {report.limited_by}"]),
        *((word, [sentence]) for word, sentence in report.quality.items()),
        ("masses", report.masses),
        ("bars", report.bars),
        ("slabs", report.slabs),
        ("quiet", report.quiet),
        ("settling", list(filter(None, [report.settling]))),
        ("may meet", list(filter(None, [report.meeting]))),
        ("moved", report.moved),
        ("damping ratio", report.ratios),
        ("steps", [_steps_text(report)]),
        ("expected time", [_seconds_text(report)]),
        ("error bar", list(filter(None, [report.error_bar]))),
        ("compiled in", report.compiled or ["nothing beyond contacts"]),
        ("not used", report.left_out or ["nothing"]),
        ("warnings", report.warnings or ["none"]),
    ]
    return [(name, lines) for name, lines in rows if lines]


def _steps_text(report: Report) -> str:
    """Two digits of what is not known beforehand."""
    least, most = report.steps_between
    if least == most:
        return f"{report.steps}"
    steps, least, most = (int(float(f"{n:.2g}")) for n in (report.steps, least, most))
    return f"about {steps}" if least == most else f"about {steps}, between {least} and {most}"


def _seconds_text(report: Report) -> str:
    least, most = map(duration, report.seconds_between)
    between = "" if least == most else f", between {least} and {most}"
    return f"about {duration(report.expected_seconds)} of processor{between}"


def paths_text(paths: dict[str, Path]) -> str:
    """Where to look after a run."""
    names = {"curve": ("curve", FORMATS), "crack picture": ("cracks", FORMATS), "summary": ("summary", ("json",))}
    first = {f"{stem}.{form}": word for word, (stem, forms) in names.items() for form in forms}
    rows = [(word, [str(paths[name])]) for name, word in first.items() if name in paths]
    others = [name for name in paths if name not in first]
    return aligned([*rows, ("also there", [", ".join(others)])] if others else rows, wrap=False)


def summary_text(summary: Summary) -> str:
    """The figures that matter, and a sentence on how far to trust them."""
    return aligned(summary_rows(summary))


def summary_rows(summary: Summary) -> Rows:
    """The same, row by row; what there is nothing to say of is left out."""
    driven = has_drive(summary)
    rows = [
        *(_peak_rows(summary) if driven else _rest_rows(summary)),
        *_collapse_rows(summary),
        ("left out", [f"{summary.left_out} (limit.accuracy = 'none')"] if summary.left_out else []),
        *_gauge_rows(summary, driven),
        ("measured", measured_lines(summary.beside_measured) if summary.beside_measured else []),
        ("standard", standard_lines(summary.standard) if summary.standard else []),
        ("compression", [pressed_text(summary)] if summary.compression_max_pa else []),
        *((name, [words]) for name, words in summary.words_on_elements.items()),
        *_balance_rows(summary, driven),
        *(_slow_rows(summary) if driven and not summary.in_real_time else []),
        ("accuracy", [accuracy_text(summary)] if summary.control and driven else []),
        ("sudden cracks", [sudden_text(summary)] if summary.sudden_cracks else []),
        ("steps", ["not known" if summary.steps is None else f"{summary.steps}"]),
    ]
    judged = [("trust", [trust(summary)]), ("advice", advice(summary)), ("time", [summary.time])]
    return [(name, lines) for name, lines in [*_with_bars(rows, summary), *judged] if lines]


def _with_bars(rows: Rows, summary: Summary) -> Rows:
    """The same, each number with its bar where the run was refined."""
    if summary.numerical_error is None:
        return rows
    swings = summary.shaking.gauges or {} if summary.shaking is not None else {}
    return summary.numerical_error.with_bars(rows, {name: swing.quantity for name, swing in swings.items()})


def _gauge_rows(summary: Summary, driven: bool) -> Rows:
    """Readings of the gauges; of a run whose ground shakes, its other results as well."""
    if summary.shaking is not None:
        return shaking_rows(summary.shaking, summary.collapse is not None)
    return [(name, [gauge_text(readings, driven)]) for name, readings in (summary.gauges or {}).items()]


def _collapse_rows(summary: Summary) -> Rows:
    """The factor of a load that grew, cycles, the tilt, and what fell."""
    grown, tilt = summary.collapse_load, summary.tilt_rad
    branch, fallen = grown.branch if grown else None, summary.collapse
    return [
        ("load factor", factor_text(grown, bool(summary.interrupted)) if grown else []),
        ("past the collapse", [branch_text(branch)] if branch else []),
        ("cycles", [cycles_text(summary.cycles)] if summary.cycles else []),
        ("tilt of gravity", [] if tilt is None else [tilt_text(tilt, " at the end")]),
        (
            "collapse",
            [collapse_text(fallen, summary.section_m2, summary.shaking)] if fallen else [],
        ),
    ]


def _balance_rows(summary: Summary, driven: bool) -> Rows:
    """Energies and forces that add up."""
    loads = loads_text(summary) if driven else ""
    return [
        ("work of dead loads", [loads] if loads else []),
        ("energy balance", [f"open by {number_text(summary.energy_imbalance, 1.0, 'of the external work')}"]),
        ("force balance", [] if summary.force_balance is None else [balance_text(summary)]),
    ]


def _slow_rows(summary: Summary) -> Rows:
    """By what it can be seen whether the test was slow enough to be static."""
    apart, kinetic = summary.reaction_mismatch_max, summary.kinetic_over_internal_max
    return [
        ("drive and support", [NO_FORCE if apart is None else f"differ by at most {100.0 * apart:.4g} % of the peak"]),
        ("kinetic energy", [f"at most {_share(kinetic, 4)} of the internal energy"]),
    ]


def balance_text(summary: Summary) -> str:
    """How well forces and moments add up to nothing, and how far the specimen is from rest."""
    makes = "inertia makes" if (summary.energy_j or {}).get("damping") == 0.0 else "damping and inertia make"
    motion = "" if summary.motion_at_end is None else f"; at the end {makes} {summary.motion_at_end:.2g} of it"
    return f"open by {summary.force_balance:.2g} of the largest force{motion}"


def _peak_rows(summary: Summary) -> Rows:
    section = summary.section_m2
    rises = "; it still rose at the end" if still_rises(summary) else ""
    return [
        ("peak stress", [stress_text(summary.peak_stress_pa, section) + rises]),
        ("displacement at peak", [number_text(summary.displacement_at_peak_m, 1e3, "mm")]),
        *_lowest_rows(summary),
        ("stress at the end", [stress_text(summary.final_stress_pa, section)]),
    ]


def _lowest_rows(summary: Summary) -> Rows:
    """The peak to the other side, of a drive that turns back."""
    lowest = summary.lowest_stress_pa
    if not summary.cycles or lowest is None or lowest >= 0.0:
        return []
    return [
        ("lowest stress", [stress_text(lowest, summary.section_m2)]),
        ("displacement there", [number_text(summary.displacement_at_lowest_m, 1e3, "mm")]),
    ]


def _rest_rows(summary: Summary) -> Rows:
    """Of a scene without a drive: how far the dead loads have settled, if they do, and what the supports bear at the
    end."""
    unbalanced = summary.unbalanced_after_settling
    left = [number_text(unbalanced, 1.0, "of the dead loads still unbalanced")]
    return [
        *([] if unbalanced is None else [("settling", left)]),
        ("reactions x, y, z", reaction_lines(summary.reactions) or ["no supports"]),
    ]


def cycles_text(cycles: list[dict[str, Any]]) -> str:
    """How many cycles there were, what they dissipated, and what is left of the stiffness; the first few in figures."""
    losses = [cycle.get("dissipated_j") for cycle in cycles[:FEW]]
    dissipated = ", ".join("-" if loss is None else f"{loss:.3g}" for loss in losses)
    more = ", ..." if len(cycles) > FEW else ""
    first, last = (cycles[k].get("stiffness_pa_per_m") for k in (0, -1))
    left = f"; stiffness of the last over the first: {last / first:.2g}" if first and last and len(cycles) > 1 else ""
    return f"{len(cycles)}, dissipating {dissipated}{more} J{left}"


def tilt_text(tilt: float, when: str = "") -> str:
    """By how much (rad) gravity was turned."""
    return f"{degrees(tilt):.4g} deg{when}, tangent {tan(tilt):.4g}"


def collapse_text(fallen: FirstFall, section: float | None = None, shaking: Shaking | None = None) -> str:
    """Which block fell first, when, and when and at what its fall began; and how hard it hit the drive later. Times are
    those from the first step, or since the settling where the ground shakes.

    section: m2, of the drive.
    """
    blow = f"; later, blocks that fell hit the drive with up to {stress_text(fallen.blow_pa, section)}"
    return f"{_first_to_fall(fallen, shaking)}{blow if fallen.blow_pa else ''}"


def _first_to_fall(fallen: FirstFall, shaking: Shaking | None) -> str:
    sets, place = ", ".join(fallen.sets), np.array(fallen.at_m)
    at = ", ".join(f"{without_noise(x, place):.4g}" for x in place)
    what = f"block {fallen.block} ({sets}), at ({at}) m at the start, is the first to fall, after "
    what += f"{fallen.time_s - (shaking.settled_s if shaking else 0.0):.4g} s"
    if (began := fallen.began) is None:
        return f"{what}; when the fall began is not known: {fallen.began_unknown}" if fallen.began_unknown else what
    late = "; it falls at a smaller tilt already, as gravity turned on while the fall gained speed"
    tilt = "" if began.tilt_rad is None else f", with gravity turned by {tilt_text(began.tilt_rad)}{late}"
    drive = f", with the drive at {1e3 * began.displacement_m:.4g} mm" if began.displacement_m else ""
    loads = "".join(f", with {name} at {share:.4g} of its value" for name, share in (began.loads or {}).items())
    return f"{what}; the fall began after {began.time_s:.4g} s{drive}{loads}{tilt}"


def factor_text(grown: CollapseLoad, interrupted: bool) -> list[str]:
    """The factor at which the load that grows is borne no more, and who moves then."""
    borne, falls, tilts = grown.borne, grown.falls, grown.pattern == "tilt"
    angle = f", at {degrees(atan(borne)):.4g} deg" if tilts else ""
    loops = grown.loops
    leg, moved = leg_text(loops) if loops else "", [fall.words for fall in grown.caught or []]
    if falls is None and loops and not interrupted:
        points = [f"{factor:g}" for factor in loops.history]
        return [f"borne along its whole path, through {', '.join(points[:FEW])}{', ...' * (len(points) > FEW)}"]
    if falls is None:
        ends = "the run was interrupted here" if interrupted else "the load ends here (limit.up_to)"
        return [*moved, f"{borne:.6g} is borne{leg}{angle}: {ends}, and nothing has fallen"]
    sets, moving = ", ".join(grown.sets), grown.moving
    return [
        *moved,
        f"{borne:.6g} is borne{leg}{angle}, {falls:.6g} is not; found in {grown.trials} trials, to "
        f"{percent(grown.accuracy)}",
        f"{moving} of {len(grown.moved)} blocks move; block {grown.first}"
        + (f" of '{sets}' moves most" if sets else " moves most"),
    ]


def leg_text(loops: LoadLoops) -> str:
    """On which leg of a load that goes to and fro the run ended."""
    history, leg = loops.history, loops.leg
    if not 0 < leg <= len(history):
        return ""
    start = history[leg - 2] if leg > 1 else 0.0
    return f" on leg {leg} of {len(history)}, from {start:g} to {history[leg - 1]:g}"


def branch_text(led: CollapseBranch) -> str:
    """How far a gauge was controlled behind the collapse, and what the factor was there."""
    if not led.led:
        return f"'{led.gauge}' was not controlled"
    near = f"within {percent(led.out_of_balance_max)} of the collapse factor of equilibrium, in {led.steps} steps"
    stands = ": it stands no more by itself" if led.ends == "zero" else ""
    factor = 0.0 if led.ends == "zero" else led.factor_at_end
    return f"the factor is {factor:.4g} where '{led.gauge}' is {1e3 * led.reached_m:.4g} mm{stands}; {near}"


def gauge_text(readings: Readings, driven: bool = True) -> str:
    """Readings of a gauge; without a drive there is no peak."""
    if readings.unit is not None:
        return f"{number_text(readings.final, 1.0, readings.unit)} at the end"
    at_peak, final = number_text(readings.at_peak_m, 1e3, "mm"), number_text(readings.final_m, 1e3, "mm")
    return f"{at_peak} at the peak, {final} at the end" if driven else f"{final} at the end"


def pressed_text(summary: Summary) -> str:
    """The largest compression of a contact and of the mean of a unit, beside the strength where one is checked."""
    share, mean = summary.compression_over_strength, summary.unit_compression_max_pa
    checked = "" if share is None else f", {share:.3g} of its strength"
    of_units = f", {number_text(mean, 1e-6, 'MPa')} in the mean of a unit" if mean else ""
    return f"{number_text(summary.compression_max_pa, 1e-6, 'MPa')} at most in a contact{checked}{of_units}"


def loads_text(summary: Summary) -> str:
    """Work of the dead loads after settling, where that is not little beside the work of the drive; else nothing."""
    drive, loads = summary.work_of_drive_j or 0.0, summary.work_of_loads_after_settling_j or {}
    much = [f"{name} {work:.3g} J" for name, work in loads.items() if work and abs(work) > TOLD * abs(drive)]
    return f"{', '.join(much)} (the drive {drive:.3g} J); a load that is lifted does negative work" if much else ""


def accuracy_text(summary: Summary) -> str:
    """Accuracy that was asked of a drive, and the numbers that show how far it was reached."""
    control = summary.control or {}
    wanted = f"{_share(control.get('accuracy'), 6)} asked for"
    damping = damping_words(summary.damping_over_external)
    energies = summary.energy_j or {}
    cracked = any(energies.get(key, 1.0) for key in ("fracture_mode_1", "fracture_mode_2"))
    if not cracked and not energies.get("crushing"):
        moved = summary.joints_opened_or_slid
        what = f"{moved} joint{'s'[: moved > 1]} opened or slid; " if moved else "no contact was damaged; "
        return f"{wanted}; {'' if moved is None else what}{damping}"
    mean, largest = (_share(control.get(key)) for key in ("mean_lag", "largest_lag"))
    return (
        f"{wanted}; after the first damage the specimen lagged behind the drive, by {mean} of the work on average, "
        f"{largest} at most; {damping}"
    )


def damping_words(fraction: float | None) -> str:
    """Share of the work of the drive that damping took; or gave, where it pulls along what lags behind."""
    if fraction is None:
        return "the drive did no work"
    if fraction >= -BELOW_0:
        return f"damping took {percent(fraction)} of the work"
    return f"damping gave {percent(-fraction)} of the work, by pulling along what lagged behind the drive"


def sudden_text(summary: Summary) -> str:
    """How many sudden cracks there were, what they released, and where and when the largest came."""
    cracks = summary.sudden_cracks or []
    largest = max(cracks, key=lambda crack: crack.released_j)
    what = "one" if len(cracks) == 1 else f"{len(cracks)}, the largest"
    place = largest.place or "where a contact slipped or opened without a crack"
    return (
        f"{what} at {1e3 * largest.displacement_m:.4g} mm, {place}; together they released "
        f"{_share(summary.released_over_dissipated)} of all energy that was lost"
    )


def _share(value: float | None, digits: int = 2) -> str:
    return "not known" if value is None else percent(value, digits)
