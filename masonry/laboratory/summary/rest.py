"""Which block is farthest from rest, after the settling and at the end."""

from typing import Any

from masonry.assembly.assemble import Assembly
from masonry.timeloop.recording import Outcome


def farthest_from_rest(assembly: Assembly, outcome: Outcome, settles: bool) -> dict[str, Any]:
    """What is left of the motion of single blocks, on their own scales; nothing where nothing need be at rest.

    After the settling: the most of any block, and the one that is farthest from rest, unless the sums over all blocks
    are far from it; at the end, the one that moves most.
    """
    observed, moving = outcome.observed, outcome.found.get("moving_at_end")
    settled = None
    if settles and observed["of_a_block"][-1] >= 0.0:
        shares = {"unbalanced": float(observed["of_a_block"][-1]), "kinetic": float(observed["energy_of_a_block"][-1])}
        settled = _place(assembly, int(observed["block"][-1])) | shares
    end = None if moving is None else _place(assembly, moving[0]) | {"kinetic": moving[1]}
    return {"unrest_after_settling": settled, "moving_at_end": end}


def _place(assembly: Assembly, block: int) -> dict[str, Any]:
    """A block, and where it was made."""
    return {"block": block, "at_m": assembly.model.layout.centroid[block].tolist()}
