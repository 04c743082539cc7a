"""How far to trust the factor of a load that grew until something fell, and the branch behind its collapse."""

from typing import Any

from masonry.judgement.words import percent

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
