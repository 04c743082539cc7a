"""Bonds that have nothing left retire: two blocks whose bonds are all broken meet by patches from then on."""

import numpy as np

from masonry.kernels.patches import SHEAR_LOST, gap_of
from masonry.kernels.planes import plane_of
from masonry.kernels.refreshing import refresh
from masonry.model.large.meeting import Large, keys
from masonry.model.model import Model
from masonry.timeloop.large_motion import make_room

SPENT = 1e-3
"""Share of its strength that a broken bond has left, at most: at seven softening lengths of the exponential law."""


def retire(model: Model) -> None:
    """Let the bonds between two blocks go once all of them are broken; patches take their shear traction over.

    A joint with residual cohesion keeps its bonds, since patches have none. What the bonds dissipated is final.
    """
    large = model.large
    assert large is not None
    broken = _broken(model, large)
    if not broken.any():
        return
    joints, count = model.joints, len(large.near.pieces.body)
    key = np.minimum(joints.block_a, joints.block_b) * count + np.maximum(joints.block_a, joints.block_b)
    left = np.unique(key[large.alive & ~broken])
    going = np.flatnonzero(broken & ~np.isin(key, left))
    if len(going) == 0:
        return
    tractions = {int(k): _traction(model, large, going[key[going] == k]) for k in np.unique(key[going])}
    large.near.account[SHEAR_LOST] += _shear_energy(model, large, going)
    large.alive[going] = False
    model.contacts.area[going] = 0.0
    model.contacts.force[going] = large.bonds.force[going] = 0.0
    large.near.search.held[:] = np.isin(large.near.search.bonded, key[large.alive])
    large.near.search.built[:] = -np.inf
    while not refresh(large.near, 0.0):
        make_room(model)
        large = model.large
        assert large is not None
    _hand_over(model, tractions, count)


def _broken(model: Model, large: Large) -> np.ndarray:
    """(C,) which of the bonds that hold have no strength left."""
    found = np.zeros(len(model.group), dtype=bool)
    for g, joint in enumerate(model.groups.properties):
        if joint.tensile_strength is None or np.any(joint.residual_cohesion or 0.0):
            continue
        own = slice(model.groups.bounds[g], model.groups.bounds[g + 1])
        tension, shear = model.state.intact_n[own], model.state.intact_s[own]
        found[own] = tension * shear < SPENT if joint.combined is not None else np.maximum(tension, shear) < SPENT
    return found & large.alive


def _traction(model: Model, large: Large, which: np.ndarray) -> np.ndarray:
    """(3,) Pa: the mean traction on side a of some bonds that press."""
    area = model.contacts.area[which]
    return np.asarray(large.bonds.force[which].sum(axis=0) / area.sum())


def _shear_energy(model: Model, large: Large, which: np.ndarray) -> float:
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
        along = traction - (traction @ n) * n
        for k in range(points.held[s]):
            gap = gap_of(pairs, points, near.motion, p, k)
            most = -rules.tan_friction[pairs.law[p]] * rules.normal_stiffness[pairs.law[p]] * min(gap, 0.0)
            size = float(np.linalg.norm(along))
            points.shear[s, k] = along * min(1.0, most / size) if size > 0.0 else 0.0
            held = float(points.shear[s, k] @ points.shear[s, k])
            near.account[SHEAR_LOST] -= 0.5 * points.area[s, k] * held / rules.shear_stiffness[pairs.law[p]]
