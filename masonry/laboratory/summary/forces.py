"""Forces of supports, the drive and the dead loads on the specimen, and the balance of all forces."""

from typing import Any

import numpy as np

from geometry.specimens.placed import FLOOR
from masonry.assembly.assemble import Assembly
from masonry.configuration.configuration import configuration_of
from masonry.laboratory.summary.scales import Scales
from masonry.monitors.reactions import balance, moved_by, open_by
from masonry.results.summary import Forces
from masonry.timeloop.run_outcome import Outcome


def forces(assembly: Assembly, outcome: Outcome, scales: Scales) -> Forces:
    """Reactions, and three measures of equilibrium."""
    rows, standing = outcome.history.rows, outcome.standing
    size = float(np.ptp(assembly.specimen.blocks.points, axis=0).max())
    least = configuration_of(assembly.model).rounding(float(rows["kinetic"].max()))
    return Forces(
        reactions=_reactions(assembly, outcome),
        force_balance=open_by(standing.values(), size, least) if standing else None,
        motion_at_end=moved_by(standing["end"], standing.values(), size) if "end" in standing else None,
        reaction_mismatch_max=None if assembly.scene.drive is None else _mismatch(rows, scales),
    )


def _reactions(assembly: Assembly, outcome: Outcome) -> dict[str, Any]:
    """At the peak and at the end: what supports, drive and dead loads exert."""
    scene, outer = assembly.scene, assembly.recording.surroundings
    on: dict[str | None, str] = {f"support.{k}": support.on for k, support in enumerate(scene.support)}
    on |= {FLOOR: FLOOR, **{element.plan.environment: element.on for element in assembly.model.elements}}
    if scene.drive is not None:
        on["drive"] = scene.drive.on
    holds, loads = tuple((one.name, on[one.name]) for one in outer.holds), tuple(one.name for one in outer.loads)
    return {when: balance(holds, loads, standing) for when, standing in outcome.standing.items()}


def _mismatch(rows: dict[str, np.ndarray], scales: Scales) -> float | None:
    """The largest difference between the stresses at the drive and at the supports, over the peak; None without one."""
    mismatch = np.abs(rows["stress"] - rows["support_stress"])[scales.counting]
    return float(mismatch.max() / scales.stress) if scales.stress > 0 and scales.counting.any() else None
