"""Forces of supports and the drive on a specimen, in words."""

from collections.abc import Mapping
from typing import Any

NOTHING = 1e-9
"""Share of the largest force up to which another is printed as 0."""


def reaction_lines(reactions: Mapping[str, Any] | None) -> list[str]:
    """A line for each support and the drive: what it exerts at the end; 0 for what is rounding beside the largest."""
    end = (reactions or {}).get("end") or {}
    acts = {
        name: reaction
        for name, reaction in end.items()
        if isinstance(reaction, dict) and reaction.get("on") and reaction.get("force_n")
    }
    threshold = NOTHING * max(
        (abs(force or 0.0) for reaction in acts.values() for force in reaction["force_n"]), default=0.0
    )
    words = {name: [_word(force, threshold) for force in reaction["force_n"]] for name, reaction in acts.items()}
    return [f"{name} ({acts[name]['on']}): {', '.join(forces)} N" for name, forces in words.items()]


def _word(force: float | None, threshold: float) -> str:
    if force is None:
        return "not known"
    return f"{force:.4g}" if abs(force) > threshold else "0"
