"""Bonds that have nothing left retire: two blocks whose bonds are all broken meet by patches from then on."""

import numpy as np

from masonry.kernels.patches import NORMAL_GAINED, SHEAR_LOST, gap_of
from masonry.kernels.planes import plane_of
from masonry.kernels.refreshing import refresh
from masonry.model.large.meeting import keys
from masonry.model.model import Model
from masonry.monitors.energy import stored_in_contacts
from masonry.timeloop.large_motion import make_room

SPENT = 1e-3
"""Share of its strength that a broken bond has left, at most: at seven softening lengths of the exponential law."""


def retire(model: Model) -> None:
    """Let the bonds between two blocks go once all of them are broken; patches take their shear traction over.

    A joint with residual cohesion keeps its bonds, since patches have none. What the bonds dissipated is final. What
    their springs hold is booked as lost, and what the new points hold as gained.
    """
    assert model.large is not None
    bonds, search, account = model.large.bonds, model.large.near.search, model.large.near.account
    broken = _broken(model, bonds.alive)
    if not broken.any():
        return
    joints, count = model.joints, len(model.large.near.pieces.body)
    key = joints.block_a * count + joints.block_b
    going = np.flatnonzero(broken & ~np.isin(key, key[bonds.alive & ~broken]))
    if len(going) == 0:
        return
    sheared, before = _shear_energy(model, going), stored_in_contacts(model)
    tractions = _tractions(key[going], bonds.force[going], model.contacts.area[going])
    bonds.alive[going] = False
    model.contacts.area[going] = 0.0
    model.contacts.force[going] = bonds.force[going] = 0.0
    account[SHEAR_LOST] += sheared
    account[NORMAL_GAINED] -= before - stored_in_contacts(model) - sheared
    search.held[:] = np.isin(search.bonded, key[bonds.alive])
    search.built[:] = -np.inf
    while not refresh(model.large.near, 0.0):
        make_room(model)
    _hand_over(model, tractions, count)


def _broken(model: Model, alive: np.ndarray) -> np.ndarray:
    """(C,) which of the bonds that hold have no strength left."""
    found = np.zeros(len(model.group), dtype=bool)
    for g, joint in enumerate(model.groups.properties):
        if joint.tensile_strength is None or np.any(joint.residual_cohesion or 0.0):
            continue
        own = slice(model.groups.bounds[g], model.groups.bounds[g + 1])
        tension, shear = model.state.intact_n[own], model.state.intact_s[own]
        found[own] = tension * shear < SPENT if joint.combined is not None else np.maximum(tension, shear) < SPENT
    return found & alive


def _tractions(key: np.ndarray, force: np.ndarray, area: np.ndarray) -> dict[int, np.ndarray]:
    """Mean traction (3,) Pa on side a of each pair of blocks; key (R,) of the pairs of bonds, force (R, 3) N."""
    pairs, which = np.unique(key, return_inverse=True)
    total = np.stack([np.bincount(which, weights=force[:, i]) for i in range(3)], axis=1)
    return dict(zip(pairs.tolist(), total / np.bincount(which, weights=area)[:, None], strict=True))


def _shear_energy(model: Model, which: np.ndarray) -> float:
    """J that the shear springs of some bonds hold."""
    normal, force, area = (array[which] for array in (model.contacts.normal, model.contacts.force, model.contacts.area))
    stiffness = np.array([joint.shear_stiffness for joint in model.groups.properties])[model.group[which]]
    tangential = force - np.einsum("ci,ci->c", force, normal)[:, None] * normal
    return float(np.sum(np.einsum("ci,ci->c", tangential, tangential) / (2.0 * stiffness * area)))


def _hand_over(model: Model, tractions: dict[int, np.ndarray], count: int) -> None:
    """Give the points of the new patches that press the mean traction of their bonds, and book what they then hold."""
    assert model.large is not None
    near = model.large.near
    pairs, points, rules = near.pairs, near.points, near.rules
    for p in range(int(pairs.number[0])):
        s, (a, b) = pairs.slot[p], near.pieces.block[pairs.body[p]]
        traction = tractions.get(int(keys(np.array([[a, b]]), count)[0]))
        if s < 0 or traction is None:
            continue
        motion, ref = near.motion, pairs.body[p, 1 - pairs.points_of[p]]
        n = np.array(plane_of(motion.frame, motion.dual, ref, *pairs.normal[p])[:3])
        along = (traction - (traction @ n) * n) * (1.0 if a < b else -1.0)  # on side 0
        size = float(np.linalg.norm(along))
        kn, ks, tan = (rule[pairs.law[p]] for rule in rules[:3])
        for k in range(points.held[s]):
            most = -tan * kn * min(gap_of(pairs, points, near.motion, p, k), 0.0)
            points.shear[s, :, k] = along * min(1.0, most / size) if size > 0.0 else 0.0
            held = float(points.shear[s, :, k] @ points.shear[s, :, k])
            near.account[SHEAR_LOST] -= 0.5 * points.area[s, k] * held / ks
