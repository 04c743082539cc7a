"""Damage and compression: what broke, opened, slid and was pressed."""

from itertools import pairwise

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.laboratory.summary.scales import Scales
from masonry.laboratory.summary.symmetry import is_loaded_alike, symmetry_lost
from masonry.monitors import events
from masonry.monitors.collisions.pressed_patches import PatchCompression
from masonry.monitors.mode_2_area import TakenInShear
from masonry.results.joint_resultants import unit_joints
from masonry.results.summary import Damage, SuddenCrack
from masonry.timeloop.run_outcome import Outcome

BROKEN, DAMAGED = 0.95, 0.05
SUDDEN = 1e-3
"""Share of all energy lost, by cracks, friction and damping, from which on a sudden crack is listed."""
ROUNDING = 1e-9
"""Share of the external work below which what sudden cracks released is but rounding."""
TENSOR = np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])
"""Where xx yy zz yz xz xy stand in the tensor."""
MOVED = 1e-12
"""Openings and slips (m) up to this one, far less than an atom, are but rounding."""


def cracks(assembly: Assembly, outcome: Outcome, scales: Scales, sudden: list[SuddenCrack]) -> Damage:
    """Sudden cracks, broken areas, slips, the largest compression."""
    joints, frames, observed = assembly.model.joints, outcome.history.frames, outcome.observed
    pressed = compressions(assembly, outcome)
    return Damage(
        sudden_cracks=sudden,
        released_over_dissipated=released_by(sudden) / scales.lost if sudden and scales.lost > 0.0 else 0.0,
        released_over_work=_over_work(released_by(sudden), scales),
        joints_opened_or_slid=_opened_or_slid(assembly),
        broken_area_m2=areas_beyond(assembly, outcome, BROKEN),
        damaged_area_m2=areas_beyond(assembly, outcome, DAMAGED),
        symmetry_lost=symmetry_lost(joints, frames, lambda axis: is_loaded_alike(assembly, axis)),
        mode_2_over_law=outcome.records[TakenInShear].over_law,
        slip_max=float(observed["slip"].max()) if "slip" in observed else None,
        slip_limit=assembly.scene.solver.slip_limit,
        compression_max_pa=max(pressed.values(), default=0.0),
        unit_compression_max_pa=most_in_a_unit(assembly, outcome),
        compression_over_strength=over_strength(assembly, pressed),
    )


def sudden_cracks(assembly: Assembly, outcome: Outcome, scales: Scales) -> list[SuddenCrack]:
    """Those that are listed, in the order in which they came."""
    least = max(SUDDEN * scales.lost, ROUNDING * scales.work)
    rows = events.table(assembly.model, outcome.events, outcome.history.rows, least)
    return [SuddenCrack.read(row) for row in rows]


def released_by(sudden: list[SuddenCrack]) -> float:
    """J that sudden cracks released together."""
    return sum(crack.released_j for crack in sudden)


def _over_work(released: float, scales: Scales) -> float:
    """Over the work since the settling, or what the force of the drive did, part of which a weight may take back."""
    work = max(scales.driven, float(scales.pushed[-1]))
    return released / work if work > 0.0 else 0.0


def areas_beyond(assembly: Assembly, outcome: Outcome, threshold: float) -> dict[str, float]:
    """Area (m2) by contact group whose combined damage is at least the threshold at the end."""
    damage = outcome.history.frames[-1].damage
    model = assembly.model
    return {
        name: float(model.joints.area[(model.group == g) & (damage >= threshold)].sum())
        for g, name in enumerate(model.group_names)
    }


def compressions(assembly: Assembly, outcome: Outcome) -> dict[str, float]:
    """Pa by contact group, the largest compression of a contact or of a point of patches at the rows."""
    model, taken = assembly.model, outcome.records.get(TakenInShear)
    joints = np.zeros(len(model.group)) if taken is None else taken.compression
    pressed = {name: float(joints[model.group == g].max(initial=0.0)) for g, name in enumerate(model.group_names)}
    if assembly.pairs is not None:
        names, of_patches = assembly.pairs.names, outcome.records.get(PatchCompression)
        largest = np.zeros(len(names)) if of_patches is None else of_patches.largest
        for name, compression in zip(names, largest.tolist(), strict=True):
            pressed[name] = max(pressed.get(name, 0.0), compression)
    return pressed


def most_in_a_unit(assembly: Assembly, outcome: Outcome) -> float:
    """Pa, the largest principal compression of the mean stress of a unit at any frame, 0 where it is only pulled."""
    blocks, volume = assembly.specimen.blocks, assembly.model.layout.volume
    unit, most = np.unique(blocks.unit, return_inverse=True)[1], 0.0
    whole = np.bincount(unit, volume)
    for frame in outcome.history.frames:
        mean = np.column_stack([np.bincount(unit, volume * stress) for stress in frame.stress.T]) / whole[:, None]
        tensors = mean[np.isfinite(mean).all(axis=1)][:, TENSOR]
        most = max(most, float(-np.linalg.eigvalsh(tensors).min(initial=0.0)))
    return most


def over_strength(assembly: Assembly, pressed: dict[str, float]) -> float | None:
    """The largest compression of a contact over its strength, of groups whose crushing is not modelled; None where
    these have no strength in compression."""
    contacts = {name: assembly.scene.contact_of(name) for name in pressed}
    shares = [
        pressed[name] / contact.compressive_strength
        for name, contact in contacts.items()
        if contact.compressive_strength and contact.crushing is None
    ]
    return max(shares, default=None)


def _opened_or_slid(assembly: Assembly) -> int | None:
    """Joints between units of which a contact has opened beyond its elastic limit, or slid, at any time; None where
    some are patches from the start, which do not remember it."""
    state = assembly.model.state
    if len(assembly.model.swept) < len(assembly.model.group_names):
        return None
    if state.opening_max is None:
        return 0
    opened = (state.intact_n < 1.0) & (state.opening_max > MOVED)
    moved = opened | (np.linalg.norm(state.slip, axis=1) > MOVED)
    joints = unit_joints(assembly.specimen.blocks, assembly.joints)
    return sum(bool(moved[joints.contact[a:b]].any()) for a, b in pairwise(joints.start))
