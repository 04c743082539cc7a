"""Bonds that have nothing left retire: two blocks whose bonds are all broken meet by patches from then on."""

from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from geometry.joints.extents import joint_extents
from masonry.configuration.contacts import ContactsLook
from masonry.configuration.joint_forces import bond_forces
from masonry.configuration.room import make_room
from masonry.elements.joints.joint_crushing import JointCrushing
from masonry.kinematics.planes import plane_of
from masonry.laws.state import JointProperties, softens_in_shear
from masonry.model.large.meeting import Large, keys
from masonry.model.model import Model
from masonry.patches.arrays import AREA, NORMAL_GAINED, SHEAR, SHEAR_LOST, Near
from masonry.patches.press import pressing_gap, stored
from masonry.patches.refreshing import refresh
from masonry.patches.slack import hold
from masonry.simd import FOUR

STRENGTH_LEFT = 1e-3
"""Share of its strength that a broken bond has left, at most: at seven softening lengths of the exponential law."""

HINGE = 0.1
"""rad: two blocks that turned by more against each other about a cracked joint, of which nothing is in tension, meet
like others: what is left of the joint would not let them touch elsewhere."""


class Carried(NamedTuple):
    """Load of the bonds of two blocks: force (3,) N on the first one; J that they hold by pressure and by shear; and
    where they were (n, 3) m in the undeformed shape, and how far crushed, as of JointCrushing.to_hand_over."""

    force: np.ndarray
    pressed: float
    sheared: float
    place: np.ndarray
    crushed: np.ndarray


def retire(model: Model, large: Large, crushing: JointCrushing) -> None:
    """Let the bonds between two blocks go once all of them are broken; patches take over what they carry.

    What the bonds dissipated is final. What their springs hold is booked as lost, and what the new points hold as
    gained: no less, but where the shear of bonds that stick was spread otherwise than their pressure.
    """
    bonds, search, account = large.bonds, large.near.search, large.near.account
    if not bonds.alive.any():
        return
    broken = bonds.alive & (_broken(model, large) | _slid_past(model, large, bonds.alive))
    if not broken.any():
        return
    joints, count = model.joints, len(large.near.pieces.body)
    key = joints.block_a * count + joints.block_b
    broken |= bonds.alive & _hinges(model, large) & np.isin(key, key[broken])
    going = np.flatnonzero(broken & ~np.isin(key, key[bonds.alive & ~broken]))
    if len(going) == 0:
        return
    left = _carried(model, large, crushing, key[going], going)
    contacts = ContactsLook(model)
    before = contacts.look()
    bonds.alive[going] = False
    bonds.runs[:, 3] = np.where(bonds.alive[bonds.runs[:, 2]], bonds.runs[:, 3], bonds.runs[:, 2])
    large.parted[going] = model.state.slip[going]  # here the law is elastic, and bears nothing
    crushing.part(large.parted, going)
    model.contacts.area[going] = 0.0
    model.contacts.force[going] = bonds.force[going] = 0.0
    sheared = sum(one.sheared for one in left.values())
    account[SHEAR_LOST] += sheared
    account[NORMAL_GAINED] -= before - contacts.look() - sheared
    search.alive[:] = np.isin(search.bonded, key[bonds.alive])
    search.built[:] = -np.inf
    while refresh(large.near) < 0.0:
        make_room(model, large)
    for blocks, pairs in _pairs_of(large.near, left.keys(), count).items():
        _hand_over(large.near, crushing, pairs, left[blocks])


def _broken(model: Model, large: Large) -> np.ndarray:
    """(C,) which bonds have no strength left beyond that of patches, or never had any, and no dilation to come."""
    broken = np.zeros(len(model.group), dtype=bool)
    for g, joint in enumerate(model.groups.properties):
        if joint.tensile_strength is None:
            continue
        own = slice(model.groups.bounds[g], model.groups.bounds[g + 1])
        tension, shear = model.state.intact_n[own], model.state.intact_s[own]
        pulled, sheared = joint.tensile_strength > 0.0, softens_in_shear(joint)
        both = tension * shear if joint.combined is not None else np.maximum(tension * pulled, shear * sheared)
        broken[own] = both * (pulled | sheared) < STRENGTH_LEFT
        if joint.tan_dilation is not None:
            broken[own] &= _has_risen(model, large, own, joint)
    return broken


def _slid_past(model: Model, large: Large, alive: np.ndarray) -> np.ndarray:
    """(C,) which bonds slid so far that nothing of one side of their joint faces the other any more."""
    u, normal = large.parted, model.contacts.normal
    slip = np.linalg.norm(u - np.einsum("ci,ci->c", u, normal)[:, None] * normal, axis=1)
    if not np.any(slip[alive] > large.near.search.skin[0]):
        return np.zeros(len(u), dtype=bool)
    axes, extent = joint_extents(model.blocks, model.joints)
    return np.asarray(np.any(np.abs(np.einsum("ckj,cj->ck", axes, u)) > extent, axis=1))


def _has_risen(model: Model, large: Large, own: slice, joint: JointProperties) -> np.ndarray:
    """(n,) where faces do not dilate any more: they slid to the cut-off, or stood open wider than they rise by then.

    Bonds stay where they were made, so what slides on past the skin is detected again and dilates no more.
    """
    assert joint.dilation_cutoff is not None
    end = np.minimum(joint.dilation_cutoff, large.near.search.skin[0])
    slid, opened = model.state.plastic_slip[own] >= end, model.state.opening_max[own] > joint.tan_dilation * end
    return np.asarray(slid | opened)


def _hinges(model: Model, large: Large) -> np.ndarray:
    """(C,) which bonds press, and would break if they did not, between blocks that turned far against each other."""
    joints, frames, u = model.joints, large.bonds.frames, large.parted
    cosine = 0.5 * (np.einsum("cij,cij->c", frames[joints.block_a], frames[joints.block_b]) - 1.0)
    breaks = np.array([joint.tensile_strength is not None for joint in model.groups.properties], dtype=bool)
    pressed = np.einsum("ci,ci->c", u, model.contacts.normal) <= 0.0
    return np.asarray(breaks[model.group] & pressed & (cosine < np.cos(HINGE)))


def _carried(
    model: Model, large: Large, crushing: JointCrushing, key: np.ndarray, which: np.ndarray
) -> dict[int, Carried]:
    """Load of the bonds `which`, by the key (R,) of their two blocks."""
    normal, force, area = (array[which] for array in (model.contacts.normal, model.contacts.force, model.contacts.area))
    kn, ks = (
        np.array([getattr(joint, name) for joint in model.groups.properties])[model.group[which]]
        for name in ("normal_stiffness", "shear_stiffness")
    )
    along = np.einsum("ci,ci->c", force, normal)
    across = np.sum(force**2, axis=1) - along**2
    pairs, of = np.unique(key, return_inverse=True)
    pressed = np.bincount(of, np.minimum(along, 0.0) ** 2 / (2.0 * kn * area))
    sheared = np.bincount(of, np.divide(across, 2.0 * ks * area, out=np.zeros(len(ks)), where=ks > 0.0))
    total = np.zeros((len(pairs), 3))
    np.add.at(total, of, bond_forces(model, large, which))
    carried = {}
    for k, (blocks, *one) in enumerate(zip(pairs, total, pressed, sheared, strict=True)):
        own, (force, pressure, shear) = which[of == k], one
        carried[int(blocks)] = Carried(force, pressure, shear, model.joints.point[own], crushing.to_hand_over(own))
    return carried


def _pairs_of(near: Near, wanted: Collection[int], count: int) -> dict[int, list[int]]:
    """The pairs of pieces that touch, by the key of their two blocks, of those that are wanted."""
    touching: dict[int, list[int]] = {}
    for p in range(int(near.pairs.number[0])):
        key = int(keys(near.pieces.block[near.pairs.body[p]][None], count)[0])
        if near.pairs.slot[p] >= 0 and key in wanted:
            touching.setdefault(key, []).append(p)
    return touching


def _hand_over(near: Near, crushing: JointCrushing, which: list[int], left: Carried) -> None:
    """Give the points of the new patches of two blocks what their bonds carried: as much energy of pressure, by a slack
    of their gaps, and as much shear force, spread as the pressure is. So faces that dilated stay apart as they slide on
    under pressure. They hold no more energy of shear than the bonds did; where friction bears less than that, it
    begins to slide in the next step. Book what they hold."""
    pairs, points, motion, rules = near.pairs, near.points, near.motion, near.rules
    held = {}
    for p in which:
        crushing.hand_over(p, left.place, left.crushed)
        near.account[NORMAL_GAINED] -= stored(pairs, points, rules, motion, p)[0]
        pairs.slack[p] = 0.0
        held[p] = stored(pairs, points, rules, motion, p)[0]
    if left.pressed == 0.0:
        for p in which:
            hold(near, p, 0.0)
        return
    if sum(held.values()) == 0.0:  # faces that dilated are apart, and stand on each other's roughness
        held = _pressed(near, which, left.pressed)
    whole = sum(held.values())
    for p in which:
        near.account[NORMAL_GAINED] += hold(near, p, left.pressed * held[p] / whole)
    pressures = {p: pressures_of(near, p) for p in which}
    areas = {p: areas_of(near, p) for p in which}
    thrust = sum(float(areas[p] @ pressures[p]) for p in which)
    sheared, tractions = 0.0, {}
    for p in which:
        ref, other = pairs.body[p, 1 - pairs.points_of[p]], pairs.body[p, pairs.points_of[p]]
        n = np.array(plane_of(motion.frame, motion.dual, ref, *pairs.normal[p])[:3])
        on_the_reference = 1.0 if near.pieces.block[ref] < near.pieces.block[other] else -1.0
        shear_over_thrust = on_the_reference * (left.force - (left.force @ n) * n) / thrust
        tractions[p] = shear_over_thrust[:, None] * pressures[p]
        sheared += float(areas[p] @ np.sum(tractions[p] ** 2, axis=0)) / (2.0 * rules.shear_stiffness[pairs.law[p]])
    less = min(1.0, np.sqrt(left.sheared / sheared)) if sheared > 0.0 else 0.0
    for p in which:
        k = np.arange(len(pressures[p]))
        points.quads[k // FOUR, pairs.slot[p], SHEAR:, k % FOUR] = less * tractions[p].T
    near.account[SHEAR_LOST] -= less**2 * sheared


def _pressed(near: Near, which: list[int], energy: float) -> dict[int, float]:
    """Energies (J) of the pairs once they have a slack that presses all their points, about as hard as they held."""
    gaps = np.concatenate([_gaps_of(near, p) for p in which])
    areas = [areas_of(near, p).sum() for p in which]
    kn = near.rules.normal_stiffness[near.pairs.law[which]]
    near.pairs.slack[which] = -gaps.max(initial=0.0) - np.sqrt(2.0 * energy / (kn @ areas))
    return {p: stored(near.pairs, near.points, near.rules, near.motion, p)[0] for p in which}


def _gaps_of(near: Near, p: int) -> np.ndarray:
    """(K,) m, by which the points of a pair press."""
    count = near.points.number[near.pairs.slot[p]]
    return np.array([pressing_gap(near.pairs, near.points, near.motion, p, k) for k in range(count)])


def pressures_of(near: Near, p: int) -> np.ndarray:
    """(K,) Pa, how hard the points of a pair press."""
    kn = near.rules.normal_stiffness[near.pairs.law[p]]
    return np.asarray(kn * np.maximum(-_gaps_of(near, p), 0.0))


def areas_of(near: Near, p: int) -> np.ndarray:
    """(K,) m2, of the points of a pair."""
    s = near.pairs.slot[p]
    return near.points.quads[:, s, AREA].ravel()[: near.points.number[s]]
