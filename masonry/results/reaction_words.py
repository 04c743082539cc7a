"""Forces of supports and the drive on a specimen, in words."""

from collections.abc import Mapping
from typing import Any

NOTHING = 1e-9
"""Share of the largest force up to which another is printed as 0."""


def reaction_lines(reactions: Mapping[str, Any] | None) -> list[str]:
    """A line for each support and the drive: what it exerts at the end; 0 for what is rounding beside the largest."""
    end = (reactions or {}).get("end") or {}
    acts = {name: one for name, one in end.items() if isinstance(one, dict) and one.get("on") and one.get("force_n")}
    least = NOTHING * max((abs(force or 0.0) for one in acts.values() for force in one["force_n"]), default=0.0)
    words = {name: [_word(force, least) for force in one["force_n"]] for name, one in acts.items()}
    return [f"{name} ({acts[name]['on']}): {', '.join(forces)} N" for name, forces in words.items()]


def _word(force: float | None, least: float) -> str:
    if force is None:
        return "not known"
    return f"{force:.4g}" if abs(force) > least else "0"
