"""Summaries that nothing can be said against, with some numbers set anew by their keys."""

import copy
from typing import Any

DRIVEN: dict[str, Any] = {
    "energy_imbalance": 0.0,
    "dissipation_mismatch": 0.0,
    "force_balance": 0.0,
    "overlap_max": 0.0,
    "mode_2_over_law": 1.0,
    "slip_max": 0.0,
    "slip_limit": 0.25,
    "compression_over_strength": 0.5,
    "released_over_dissipated": 0.0,
    "released_over_work": 1.0,
    "damping_over_external": 0.0,
    "reaction_mismatch_max": 0.0,
    "kinetic_over_internal_max": 0.0,
    "rise_at_end": 0.0,
    "missed_between_steps": 0.0,
    "unbalanced_after_settling": 0.0,
    "kinetic_after_settling": 0.0,
    "unrest_after_settling": {"block": 3, "at_m": [0.1, 0.2, 0.3], "unbalanced": 0.0, "kinetic": 0.0},
    "moving_at_end": {"block": 3, "at_m": [0.1, 0.2, 0.3], "kinetic": 0.0},
    "control": {"accuracy": 0.01, "drag_at_peak": 0.0},
    "energy_j": {
        "external_work": 200.0,
        "elastic_blocks": 30.0,
        "elastic_contacts": 70.0,
        "kinetic": 0.0,
        "damping": 0.0,
        "area": 0.0,
        "redetection": 0.0,
    },
    "reactions": {"end": {"drive": {}, "support.0": {}}},
}
"""A slow test with a drive."""
AT_REST = DRIVEN | {"reactions": {"end": {"support.0": {}}}}
"""Dead loads that have settled."""
REAL_TIME = AT_REST | {"in_real_time": True, "collapse": None}
"""What moves in real time."""
SHAKEN = REAL_TIME | {"shaking": {"kinetic_at_end": 0.0}, "damping_after_settling": {}}
"""What the ground shakes."""
GROWN = AT_REST | {
    "collapse_load": {
        "pattern": "sideways",
        "borne": 1.0,
        "falls": 1.01,
        "accuracy": 0.01,
        "undecided": 0,
        "falls_by_turning": False,
        "swayed_over_block": 0.0,
    }
}
"""A load that grew until something fell."""
BRANCH = {
    "gauge": "top",
    "led": True,
    "ends": "until",
    "from_m": 0.0,
    "reached_m": 0.05,
    "near_to_m": 0.02,
    "leaps": 0,
    "out_of_balance_max": 0.0,
    "steps": 1000,
}
"""What a gauge showed that was led on behind the collapse."""


def with_numbers(summary: dict[str, Any], **numbers: Any) -> dict[str, Any]:
    """The summary with numbers by their keys, as `energy_j__kinetic=0.1`."""
    changed = copy.deepcopy(summary)
    for path, value in numbers.items():
        *tables, key = path.split("__")
        table = changed
        for name in tables:
            table = table[name]
        table[key] = value
    return changed


LED = with_numbers(GROWN, collapse_load__branch=BRANCH)
"""One whose gauge was led on behind the collapse."""
LOOPS = with_numbers(
    GROWN, collapse_load__falls=None, collapse_load__loops={"gauge": "top", "history": [1.0, -1.0], "leg": 2}
)
"""A load that goes to and fro, and is borne."""
