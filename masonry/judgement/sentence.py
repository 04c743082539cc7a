"""The sentence of trust: the verdict, then the largest doubts, or what is clean. It knows no doubt by name."""

from collections.abc import Mapping
from typing import Any

from masonry.judgement.doubt import SOUND
from masonry.judgement.evidence import Evidence
from masonry.judgement.judgement import judgement_of
from masonry.judgement.words import percent

CONVERGE = "`masonry converge` measures the error of resolution, of any number"
MOST = 3
"""Doubts in a sentence; `doubts` of summary.json has all of them."""


def trust(summary: Mapping[str, Any]) -> str:
    """How far the numbers may be trusted: a sentence that begins with the verdict."""
    judgement = judgement_of(summary)
    verdict, doubts = judgement.verdict, judgement.doubts
    if verdict == SOUND:
        return f"{verdict}: {motion(Evidence(summary))}, and the energy balance closes.{note(summary)}"
    more = len(doubts) - MOST
    words = [doubt.sentence for doubt in doubts[:MOST]] + [f"and {more} more"] * (more > 0)
    return f"{verdict}: {'; '.join(words)}."


def advice(summary: Mapping[str, Any]) -> list[str]:
    """Advice on all doubts, the largest first, each once; and what measures the error that some of them tell."""
    doubts = judgement_of(summary).doubts
    measured = [CONVERGE] if any(doubt.resolution for doubt in doubts) else []
    return [*dict.fromkeys(doubt.advice for doubt in doubts if doubt.advice), *measured]


def motion(evidence: Evidence) -> str:
    """In what state a sound run was."""
    if evidence.grows:
        branch = evidence.branch
        behind = (
            f", within {percent(branch['out_of_balance_max'])} of equilibrium behind the collapse" if branch else ""
        )
        return f"at rest under each factor that is borne{moved_before(evidence)}{behind}"
    if evidence.in_real_time:
        return "in real time"
    return "quasi-static" if evidence.has_drive else "at rest"


def moved_before(evidence: Evidence) -> str:
    """From which factor on a load was borne only after falls that came to rest, and how far the farthest of these went;
    "" without any."""
    falls = [Evidence(fall) for fall in evidence.table("collapse_load").get("caught") or []]
    if not falls:
        return ""
    travel = max(fall.number("travel_m") or 0.0 for fall in falls)
    return f", beyond {falls[0].number('borne') or 0.0:.4g} only after it moved by up to {1e3 * travel:.4g} mm"


def note(summary: Mapping[str, Any]) -> str:
    """Remark on cracks that left the symmetry of the specimen: no doubt of this run, but of one that is alike.

    Nothing where a factor was asked for, not what is dissipated.
    """
    if not (axis := summary.get("symmetry_lost")) or summary.get("collapse_load"):
        return ""
    return (
        f" The cracks have left the symmetry of the specimen across {axis}: where two are alike, the pace decides which"
        " one opens, and what is dissipated behind that may differ by several per cent; [scatter] decides as in a real"
        " wall."
    )
