"""The sentence of trust as it was before each doubt had a file: what is said there must be said now, and no more."""

import math
from collections.abc import Mapping
from typing import Any

from masonry.judgement.words import percent
from masonry.rows.rest_criterion import LONE, still_moving

SWAYED = 0.5
"""Share of the accuracy of a collapse factor by which blocks of the smallest one's size may move before it falls, in
small displacement: a soft arch loses twice as much of its factor by it."""


def not_enclosed(grown: dict[str, Any]) -> list[str]:
    """What speaks against the factor of a load that grew, or went to and fro."""
    loops, falls = grown.get("loops"), grown["falls"] is not None
    if not falls and loops is None:
        return ["nothing fell up to the factor at which the load ends, so this is no collapse load: raise limit.up_to"]
    if grown["borne"] == 0.0 and falls and (loops is None or loops["leg"] == 1):
        return [
            "not the least part of the load was borne: nothing resists it, or the specimen hardly stands without it"
        ]
    doubts = []
    if falls and grown["undecided"]:
        doubts.append(
            f"in {grown['undecided']} trials the specimen neither came to rest nor gathered way in time, and was taken "
            "for one that falls: the factor may be larger"
        )
    if grown.get("falls_by_turning"):
        doubts.append(
            "at the factor that is not borne a block turned by more than solver.rotation_limit before it was seen "
            'whether the specimen falls: the factor may be larger; displacements = "large" tells'
        )
    if (swayed := grown.get("swayed_over_block") or 0.0) > SWAYED * grown["accuracy"]:
        doubts.append(
            f"blocks moved by up to {swayed:.2g} of the smallest one"
            + (
                " before it fell, but the balance is that of the shape as drawn, so the factor may be too large: "
                if falls
                else ", but the balance is that of the shape as drawn: "
            )
            + 'displacements = "large" tells'
        )
    return doubts


def rests(grown: dict[str, Any]) -> str:
    """How near to equilibrium the rows of a load that grew are."""
    led = grown.get("branch")
    behind = f", within {percent(led['out_of_balance_max'])} of equilibrium behind the collapse" if led else ""
    return f"at rest under each factor that is borne{behind}"


def not_led(grown: dict[str, Any]) -> list[str]:
    """What speaks against the branch behind the collapse, where a gauge was to be led on."""
    led = grown.get("branch")
    if led is None or grown["falls"] is None:
        return []
    gauge, at = f"gauge '{led['gauge']}'", f"{1e3 * led['reached_m']:.4g} mm"
    said = {
        "stays": f"the collapse hardly moves {gauge}, so it was not led on: control one that the mechanism moves",
        "other way": f"the collapse moves {gauge} away from limit.until, so it was not led on: turn the sign of that",
        "passed": f"{gauge} read {1e3 * led['from_m']:.4g} mm before it fell, beyond limit.until, so it was not led on",
        "up_to": f"the factor came to limit.up_to where {gauge} was at {at}, short of limit.until",
        "runs away": f"{gauge} could not be controlled: at {at} it ran away although nothing pushed any more",
        "turned": f"a block turned by more than solver.rotation_limit where {gauge} was at {at}, short of limit.until: "
        'displacements = "large" goes on',
        "late": f"{gauge} came no further than {at} in {led['steps']} steps",
    }
    doubts = [said[led["ends"]]] if led["ends"] in said else []
    if led["leaps"]:
        doubts.append(
            f"the specimen leapt ahead of {gauge} {led['leaps']} times behind the collapse, as it gave way faster than "
            "the load can be led: what broke meanwhile depends on how its motion is damped"
        )
    if led["out_of_balance_max"] > grown["accuracy"]:
        doubts.append(
            f"behind the collapse motion took up to {percent(led['out_of_balance_max'])} of the collapse factor, more "
            f"than the accuracy beyond {1e3 * led['near_to_m']:.4g} mm: see the column out_of_balance"
        )
    return doubts


MISMATCH, KINETIC, IMBALANCE, DISSIPATION, UNBALANCED, OVERLAP = 0.02, 0.05, 1e-9, 0.01, 1e-3, 0.01
"""Limits for a result to be trusted: reaction mismatch, kinetic over internal energy, imbalance, the difference
between the energy that the laws booked and the work that the contacts took up, what is unbalanced after settling, and
how far contacts close over the size of their blocks."""
STILL = 1e-6
"""Limit of the kinetic over the stored energy after settling. Below it a swing is less than a thousandth of the
displacements; a specimen that slides or falls under a load only a thousandth too large is above it."""
RELEASED, PUSHED, DAMPING = 0.01, 0.01, 0.02
"""Limits: what sudden cracks release over all energy lost; over the external work, what damping gives, and takes."""
PACED = 2.5
"""Limit of what damping takes of the work of a load that goes to and fro, over the accuracy: its pace aims at less."""
TAKEN = 0.02
"""Share by which a contact may take more energy of mode II than the area under its law's curve."""
ANEW = 0.01
"""Share of the external work that contacts may gain or lose as they are found anew, in large displacement."""
BRAKED = 0.01
"""Share of the external work that local damping may take from a motion in real time."""
SLID = 0.2
"""Share of `solver.slip_limit` from which a slip is a doubt: 5 % of the joint where the limit is 25 %."""


def trust(summary: Mapping[str, Any]) -> str:
    """How far the numbers may be trusted, from the numbers themselves."""
    doubts = []
    if summary.get("interrupted"):
        doubts.append("the run was interrupted, so this is only its first part")
    if summary.get("stopped"):
        doubts.append("the run was stopped, so this is only its first part")
    imbalance = summary.get("energy_imbalance")
    if imbalance is None:
        doubts.append("the energy balance is not known")
    elif abs(imbalance) > IMBALANCE:
        doubts.append(f"the energy balance is open by {abs(imbalance):.2g} (should be under {IMBALANCE:g})")
    mismatch = summary.get("dissipation_mismatch") or 0.0
    if mismatch > DISSIPATION:
        doubts.append(
            f"laws and contacts disagree on the dissipated energy by {percent(mismatch, 3)} (should be under "
            f"{percent(DISSIPATION)}): take smaller steps"
        )
    doubts += no_numbers(summary)
    dynamic, grown = bool(summary.get("in_real_time")), summary.get("collapse_load")
    doubts += slowed(summary) if dynamic else not_at_rest(summary)
    if grown and not (summary.get("interrupted") and grown["falls"] is None):
        doubts += not_enclosed(grown) + not_led(grown)
    if (summary.get("force_balance") or 0.0) > IMBALANCE:
        doubts.append(f"forces and moments add up to {summary['force_balance']:.2g} of the largest, not to 0")
    if (overlap := summary.get("overlap_max") or 0.0) > OVERLAP:
        doubts.append(
            f"contacts close by up to {overlap:.2g} of a block's size: the normal stiffness is too low for this load"
        )
    if (anew := found_anew(summary)) > ANEW:
        doubts.append(
            f"contacts that were found anew while they pressed changed the energy by {percent(anew)} of the work: what "
            "fell came down harder or softer than it should; a larger normal stiffness lessens it"
        )
    if (taken := summary.get("mode_2_over_law") or 0.0) > 1.0 + TAKEN:
        doubts.append(
            f"a contact took {taken:.3g} times the energy of mode II that its law has: take smaller steps, or look at "
            "the law where it is your own"
        )
    if (slip := summary.get("slip_max") or 0.0) > SLID * (summary.get("slip_limit") or math.inf):
        bonds = "; blocks held by such bonds do not meet elsewhere" if summary.get("in_real_time") is not None else ""
        doubts.append(
            f"contacts slid by up to {slip:.2g} of their joints, but keep the areas that they had at first{bonds}"
        )
    if summary.get("met"):
        doubts.append(f"{summary['met']}: nothing holds them apart")
    doubts += summary.get("warnings") or []
    released = summary.get("released_over_dissipated") or 0.0
    if released > RELEASED:
        doubts.append(
            f"sudden cracks released {percent(released)} of all energy that was lost: what happened after them "
            "depends on how the vibration is damped; `masonry sensitivity` shows by how much"
        )
    damping = summary.get("damping_over_external") or 0.0
    if damping < -PUSHED and not dynamic:  # kinetic energy counts with it, which a slow run has little of
        doubts.append(f"damping added {percent(-damping)} of the work and removed none: ask for a smaller accuracy")
    if grown and grown.get("loops") and damping > max(DAMPING, PACED * grown["accuracy"]):
        doubts.append(
            f"damping took {percent(damping)} of the work of the load before any fall: something cracked or slid "
            "suddenly, and where it came to rest depends on how that is damped; `masonry sensitivity` shows by how much"
        )
    control = summary.get("control") or {}
    if (drag := control.get("drag_at_peak", 0.0)) > control.get("accuracy", 1.0):
        doubts.append(
            f"damping took {percent(min(drag, 1.0))} of the force at the peak, which may be too high by as much: ask "
            "for a smaller accuracy"
        )
    doubts += [] if dynamic or grown else not_slow(summary, damping)
    if not doubts:
        kind = "a run in real time" if dynamic else "quasi-static" if has_drive(summary) else "at rest"
        kind = rests(grown) if grown else kind
        return (
            f"{kind} and the energy balance closes: the numbers solve this model; whether the model describes the wall "
            f"depends on the scene's assumptions.{uneven(summary)}"
        )
    return "with care: " + "; ".join(doubts) + "."


def uneven(summary: Mapping[str, Any]) -> str:
    """What is said of cracks that left the symmetry of the specimen: no doubt of this run, but of one that is alike.

    Nothing where a factor was asked for, not what is dissipated.
    """
    if not (axis := summary.get("symmetry_lost")) or summary.get("collapse_load"):
        return ""
    return (
        f" The cracks have left the symmetry of the specimen across {axis}: where two are alike, the pace decides which"
        " one opens, and what is dissipated behind that may differ by several per cent; [scatter] decides as in a real"
        " wall."
    )


def found_anew(summary: Mapping[str, Any]) -> float:
    """What re-detection lost and changes of area gained or took, over the external work, or that of the drive alone
    where its weight takes that from what is pushed over."""
    energies = summary.get("energy_j") or {}
    work = max(abs(energies.get("external_work") or 0.0), summary.get("work_of_force_j") or 0.0)
    changed = abs(energies.get("area") or 0.0) + abs(energies.get("redetection") or 0.0)
    return changed / work if work > 0.0 and math.isfinite(changed) else 0.0


def no_numbers(summary: Mapping[str, Any]) -> list[str]:
    """What is said of energies that are no numbers: beyond what floating point holds; None in a file."""
    energies = (summary.get("energy_j") or {}).items()
    lost = [name.replace("_", " ") for name, value in energies if value is None or not math.isfinite(value)]
    return [f"there is no number of this energy: {', '.join(lost)}; look for a stiffness near 0"] if lost else []


def slowed(summary: Mapping[str, Any]) -> list[str]:
    """What local damping took from a motion in real time."""
    energies = summary.get("energy_j") or {}
    work, taken = (abs(energies.get(key) or 0.0) for key in ("external_work", "damping"))
    if taken <= BRAKED * work:
        return []
    return [
        f"local damping took {percent(taken / work)} of the work: what moves in real time is slower than it should be; "
        "set solver.damping = 0"
    ]


def not_at_rest(summary: Mapping[str, Any]) -> list[str]:
    """What speaks against dead loads that have settled."""
    ratio, moving = (summary.get(f"{what}_after_settling") or 0.0 for what in ("unbalanced", "kinetic"))
    if ratio > UNBALANCED or moving > STILL:
        return [
            f"the dead loads had not come to rest ({ratio:.2g} of them unbalanced, kinetic energy {moving:.2g} of the "
            "stored): raise settle.steps, or leave it out; if that does not help, the specimen cannot stand under them"
        ]
    alone = summary.get("unrest_after_settling") or {}
    if alone.get("unbalanced", 0.0) > LONE * UNBALANCED or alone.get("kinetic", 0.0) > LONE**2 * STILL:
        return [
            f"{block_at(alone)} had not come to rest under the dead loads ({alone['unbalanced']:.2g} of what it bears "
            f"is unbalanced, its kinetic energy {alone['kinetic']:.2g} of what it stores): raise settle.steps, or "
            "leave it out; if that does not help, it cannot stand under them"
        ]
    falls = (summary.get("collapse_load") or {}).get("falls") is not None
    if not has_drive(summary) and not falls and (moving := moving_at_end(summary)) > STILL:
        return [f"the specimen still moves at the end: its kinetic energy is {moving:.2g} of the stored"]
    alone = summary.get("moving_at_end") or {}
    if not has_drive(summary) and not falls and (moving := alone.get("kinetic", 0.0)) > LONE**2 * STILL:
        return [f"{block_at(alone)} still moves at the end: its kinetic energy is {moving:.2g} of what it stores"]
    return []


def block_at(alone: Mapping[str, Any]) -> str:
    """A block in words."""
    return f"block {alone['block']} at ({', '.join(f'{x:.4g}' for x in alone['at_m'])}) m"


def not_slow(summary: Mapping[str, Any], damping: float) -> list[str]:
    """What speaks against a test that is slow enough to be static; damping over the work."""
    slow = (
        ("reaction_mismatch_max", MISMATCH, "the two ends differ by {:.2g} of the peak"),
        ("kinetic_over_internal_max", KINETIC, "kinetic energy reaches {:.2g} of the internal"),
    )
    doubts, fast = [], []
    for key, limit, words in slow:
        value = summary.get(key)
        if value is None:
            doubts.append(f"{key} is not known")
        elif value > limit:
            fast.append(f"{words.format(value)} (should be under {limit:g})")
    if damping > DAMPING:
        fast.append(f"damping takes {damping:.2g} of the work (should be under {DAMPING:g})")
    if fast:
        doubts.append("not quasi-static: " + " and ".join(fast) + "; load more slowly")
    return doubts


def moving_at_end(summary: Mapping[str, Any]) -> float:
    """Kinetic over stored energy at the end."""
    energies = summary.get("energy_j") or {}
    terms = ("kinetic", "elastic_blocks", "elastic_contacts", "external_work")
    return still_moving({key: energies.get(key) or 0.0 for key in terms})


def has_drive(summary: Mapping[str, Any]) -> bool:
    """Whether the run has a drive; True where the summary has no reactions to tell."""
    end = (summary.get("reactions") or {}).get("end")
    return end is None or "drive" in end
