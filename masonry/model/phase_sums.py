"""Row sums that bound the time step: while dead loads settle, and from then on, where contacts have dashpots."""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks
from masonry.model import stable_step
from masonry.model.damping import Swing
from masonry.model.element_plan import ElementPlan, Ends
from masonry.model.large.block_motion import masses_behind
from masonry.model.large.meeting import Meetings, add_row_sums, face_matrices, face_row_sums
from masonry.model.layout import DOFS, KINDS, Layout
from masonry.model.stable_step import Side


class Outline(NamedTuple):
    """Blocks as the bound of the step sees them: both sides of the contacts, the lengths (B, 3) m of the blocks, the
    normals (C, 3) of the contacts, and the elements with their ends that blocks hold."""

    layout: Layout
    sides: tuple[Side, Side]
    length: np.ndarray
    normal: np.ndarray
    elements: tuple[tuple[ElementPlan, Ends | None], ...] = ()


class PhaseSums(NamedTuple):
    """By what share dashpots of patches shorten the step; row sums while dead loads settle; those from then on, None
    where contacts have no dashpots."""

    share: float
    settling: dict[str, np.ndarray]
    swinging: dict[str, np.ndarray] | None


class Stiffness(NamedTuple):
    """Of the contacts, (C,) N/m times their areas, dilation included, and Lame constants of the blocks (B, 2), Pa."""

    normal: np.ndarray
    shear: np.ndarray
    lame: np.ndarray


def sums_of_phases(
    blocks: Blocks,
    specimen: Outline,
    stiffness: Stiffness,
    real: dict[str, np.ndarray],
    phases: tuple[float, Swing | None],
    meetings: Meetings | None,
) -> PhaseSums:
    """The row sums of a model.

    phases  xi of local damping while dead loads settle, and what damps from then on
    """
    (xi, swing), swinging = phases, None
    sums = _row_sums(blocks, specimen, stiffness, meetings)
    share, rates = _of_meetings(blocks, specimen, real, meetings)
    if swing is not None and swing.in_contacts:
        rigid = stiffness._replace(lame=np.zeros_like(stiffness.lame))
        springs = _row_sums(blocks, specimen, rigid, meetings)
        dashpots = springs | _block_rates(blocks, specimen, stiffness, real, meetings)
        swinging = _swinging(sums, springs, dashpots, rates, real, swing)
    return PhaseSums(share, sums if rates is None else stable_step.with_dashpots(sums, rates, real, xi), swinging)


def _row_sums(
    blocks: Blocks, specimen: Outline, stiffness: Stiffness, meetings: Meetings | None
) -> dict[str, np.ndarray]:
    """By kind, (rows, dofs) the sums of |K| that bound the time step."""
    (normal, shear, lame), (layout, sides, length, face, elements) = stiffness, specimen
    sums = {kind: np.zeros((layout.rows(kind), DOFS[kind])) for kind in KINDS}
    if meetings is None:
        stable_step.contact_row_sums(sums, sides, face, normal, shear)
        stable_step.affine_row_sums(sums["affine"], layout, lame[layout.members["affine"]], length)
        stable_step.tet_row_sums(sums["tets"], layout, lame)
    else:
        add_row_sums(sums, blocks, layout, sides, length, np.maximum(normal, shear), meetings.stiffest, lame)
    for plan, ends in elements:
        if ends is not None:
            plan.add_row_sums(sums, ends, turns=meetings is not None)
    stable_step.unscale(sums, layout, length)
    return sums


def _of_meetings(
    blocks: Blocks, specimen: Outline, real: dict[str, np.ndarray], meetings: Meetings | None
) -> tuple[float, dict[str, np.ndarray] | None]:
    """Where blocks meet: by what share steps are shorter, or for tets row sums of the dashpots of faces (N s/m)."""
    layout, length = specimen.layout, specimen.length
    if meetings is None:
        return 1.0, None
    if layout.mesh is None:
        return meetings.step_fraction, None
    if not meetings.rules.dashpot.any():
        return 1.0, None
    rates = face_row_sums(blocks, layout, length, meetings.dashpots(masses_behind(layout, real)))
    stable_step.unscale(rates, layout, length)
    return 1.0, rates


def _block_rates(
    blocks: Blocks, specimen: Outline, stiffness: Stiffness, real: dict[str, np.ndarray], meetings: Meetings | None
) -> dict[str, np.ndarray]:
    """(rows, dofs) N/m: what dashpots of contacts answer with at most, over their time, of blocks that move as a whole;
    row sums of nodes are no less."""
    (normal, shear, _), (layout, sides, length, face, _) = stiffness, specimen
    if meetings is not None:
        normal = shear = np.maximum(normal, shear)
    matrices = stable_step.block_matrices(layout)
    for side in sides:
        stable_step.add_block_matrices(matrices, side, face, normal, shear)
    rates = stable_step.block_rates(matrices, real, layout, length)
    if meetings is None:
        return rates
    pressed = stable_step.block_rates(face_matrices(blocks, layout, length, meetings.stiffest), real, layout, length)
    return {kind: np.maximum(of_bonds, pressed[kind]) for kind, of_bonds in rates.items()}


def _swinging(
    sums: dict[str, np.ndarray],
    springs: dict[str, np.ndarray],
    dashpots: dict[str, np.ndarray],
    rates: dict[str, np.ndarray] | None,
    real: dict[str, np.ndarray],
    swing: Swing,
) -> dict[str, np.ndarray]:
    """The row sums as they are with dashpots in closed contacts: of the springs of contacts, N/m; of dashpots in
    proportion to them, over their time, N/m; and of the dashpots of faces, N s/m."""
    stiffer = {kind: rows + sum(swing.stiffer) * springs[kind] for kind, rows in sums.items()}
    damped = {
        kind: swing.stiffness_time * rows + (0.0 if rates is None else rates[kind]) for kind, rows in dashpots.items()
    }
    return stable_step.with_dashpots(stiffer, damped, real, swing.local)
