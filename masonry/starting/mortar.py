"""Joints in mortar of a first scene: where their numbers come from, and the tensile strength that fits the others."""

from masonry.starting.options import Entries

MORTAR = "`masonry contact` gives it from Eurocode 6 (docs/contact-table.md)"
"""Where strengths of a joint come from."""


def tension_of(entries: Entries) -> str:
    """Tensile strength with its unit: the user's, where it is among the options and stated, else two thirds of the
    cohesion; at most what the cohesion and the friction of the entries allow. Raises SceneError where it is more."""
    cohesion, friction = entries.si("cohesion"), entries.si("friction")
    highest = cohesion / friction
    if not (stated := entries.optional("tension")):
        return f"{min(cohesion / 1.5, highest) / 1e6:.4g} MPa"
    if stated[0].si > highest:
        raise entries.refusal(
            "tension", f"{stated[0].text}; a joint bears at most cohesion / friction, {highest / 1e6:.4g} MPa"
        )
    return stated[0].text
