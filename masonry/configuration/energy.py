"""The energy ledger: stored terms from the state, works by the trapezoid of each force, dissipation from the laws.

Two independent sums meet here. `imbalance` closes external work, damping, kinetic energy, the blocks' elastic energy
and the trapezoid work into the contacts: round-off for a correct step. The contacts' trapezoid work less their stored
energy must equal what the laws booked as fracture and friction: equal only as far as the steps are small.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from masonry.kernels import contact
from masonry.kernels.bonds import Bonds
from masonry.kinematics import affine, deforming, deforming_tets, tets, turning
from masonry.model.layout import KINDS
from masonry.model.model import Model
from masonry.patches.arrays import BORN, DASHPOT, FRICTION, NORMAL_GAINED, SHEAR_LOST, Near
from masonry.patches.press import stored_energy


class Seen(NamedTuple):
    """What contacts show, (C,) each: opening and slip (m), normal (tension above 0) and shear stress (Pa)."""

    opening: np.ndarray
    slip: np.ndarray
    sigma: np.ndarray
    tau: np.ndarray


@dataclass(frozen=True)
class Observation:
    """What contacts and blocks show at one moment; stress (B, 6) Pa, energies in J; in large displacement the least
    det F, and a bound on the longest stretch of any line."""

    seen: Seen
    stress: np.ndarray
    elastic_contacts: float
    elastic_blocks: float
    least: float = 1.0
    longest: float = 1.0


def observe(model: Model) -> Observation:
    """Look at every contact and block without changing them."""
    seen = np.zeros((4, len(model.group)))
    stored = _look_at_contacts(model, seen)
    if model.large is not None:
        _look_at_parted_points(model, model.large.bonds, seen)
        stored += stored_energy(model.large.near)
    stress = np.zeros((model.blocks.count, 6))
    _, affine_blocks, tet_blocks = model.bodies
    elastic, least, longest = 0.0, 1.0, 1.0
    large = model.large is not None
    for kind, file, body in (
        ("affine", deforming if large else affine, affine_blocks),
        ("tets", deforming_tets if large else tets, tet_blocks),
    ):
        if body is None:
            continue
        which = model.layout.members[kind]
        part = np.zeros((len(which), 6))
        found = file.observe(body, part) if kind == "affine" else file.observe(body, model.u, part)
        if large:
            found, smallest, largest = found
            least, longest = min(least, smallest), max(longest, largest)
        elastic += found
        stress[which] = part / model.layout.volume[which, None]
    return Observation(Seen(*seen), stress, stored, elastic, least, longest)


def stored_in_contacts(model: Model) -> float:
    """Elastic energy (J) of the contacts of the undeformed shape."""
    return _look_at_contacts(model, np.zeros((4, len(model.group))))


def _look_at_contacts(model: Model, seen: np.ndarray) -> float:
    """Fill seen (4, C), and return the stored energy (J)."""
    law_parameters, joint_properties, states, bounds = model.groups
    return sum(
        contact.observe(
            law_parameters[g], joint_properties[g], states[g], bounds[g], bounds[g + 1], *model.contacts, seen
        )
        for g in range(len(law_parameters))
    )


def _look_at_parted_points(model: Model, bonds: Bonds, seen: np.ndarray) -> None:
    """How far the material points of joints without bonds have parted, in the frame of side a; they carry nothing."""
    assert model.large is not None
    gone, joints = ~bonds.alive, model.joints
    if model.large.members is None:
        a, b = (moved(model, joints.point[gone], block[gone]) for block in (joints.block_a, joints.block_b))
    else:  # points of blocks that deform move with them at every step
        a, b = bonds.u[bonds.rows[gone].T.astype(np.int64)]
    parted = np.einsum("cji,cj->ci", bonds.frames[bonds.owner[gone]], b - a)
    normal = model.contacts.normal[gone]
    opening = np.einsum("ci,ci->c", parted, normal)
    seen[0, gone] = opening
    seen[1, gone] = np.linalg.norm(parted - opening[:, None] * normal, axis=1)
    seen[2:, gone] = 0.0


def moved(model: Model, point: np.ndarray, block: np.ndarray) -> np.ndarray:
    """(K, 3) m, how far points (K, 3) of some rigid or affine blocks have moved."""
    assert model.large is not None
    motion, arm = model.large.near.motion, point - model.layout.centroid[block]
    return np.asarray(motion.moved[block, :3] + np.einsum("kij,kj->ki", motion.frame[block], arm) - arm)


def kinetic(model: Model, before: list[np.ndarray]) -> float:
    """v(n-1/2) M v(n+1/2) / 2 (J), with which the balance closes to round-off; `before`: velocities a step earlier."""
    pairs = list(zip(present(model), before, strict=True))
    rotational = 0.0
    if model.large is not None and model.bodies.rigid is not None:
        rotational, pairs = turning.kinetic(model.bodies.rigid, model.masses["rigid"], before[0]), pairs[1:]
    return rotational + 0.5 * sum(float(np.sum(model.masses[kind] * old * body.v)) for (kind, body), old in pairs)


def velocities(model: Model) -> list[np.ndarray]:
    """Copies of the velocities of the bodies that are there; angular momenta in place of turns where blocks turn."""
    rotates = model.large is not None
    return [turning.momenta(body) if rotates and kind == "rigid" else body.v.copy() for kind, body in present(model)]


def present(model: Model) -> list[tuple[str, Any]]:
    """Kind and body of the bodies that are there."""
    return [(kind, body) for kind, body in zip(KINDS, model.bodies, strict=True) if body is not None]


def works(model: Model) -> np.ndarray:
    """J so far: work of the contacts, the damping and all loads on the bodies; and, in large displacement, what free
    rotors lose and blocks that deform take up."""
    return np.asarray(np.sum([body.work.sum(axis=0) for _, body in present(model)], axis=0))


def ledger(model: Model, view: Observation, before: list[np.ndarray]) -> dict[str, float]:
    """All terms (J) at this moment, under the names of history.UNITS, and of LARGE_UNITS in large displacement."""
    done = works(model)
    contact_work, damping, external = -float(done[0]), -float(done[1]), float(done[2])
    dissipated = model.joints.area @ model.state.dissipated
    moving = kinetic(model, before)
    lines = {}
    if model.large is not None:  # work[:, 3]: lost by free rotors, and put into blocks that deform
        lines = large_lines(model.large.near, float(done[3]) - view.elastic_blocks)
    return {
        "external_work": external,
        "elastic_blocks": view.elastic_blocks,
        "elastic_contacts": view.elastic_contacts,
        "fracture_mode_1": float(dissipated[0]),
        "fracture_mode_2": float(dissipated[1]),
        "friction": float(dissipated[2]) + (0.0 if model.large is None else float(model.large.near.account[FRICTION])),
        "damping": damping,
        "kinetic": moving,
        "contact_work": contact_work,
        "imbalance": external - damping - moving - view.elastic_blocks - contact_work - lines.get("rotor", 0.0),
        **lines,
    }


def large_lines(near: Near, rotor: float) -> dict[str, float]:
    """What large displacement books besides (J): history.LARGE_UNITS says what.

    rotor  what turning lost; and what went into blocks that deform, less what they store
    """
    account = near.account
    return {
        "rotor": rotor,
        "dashpot": float(account[DASHPOT]),
        "redetection": float(account[SHEAR_LOST]),
        "area": -float(account[NORMAL_GAINED] + account[BORN]),
    }


def open_in_contacts(terms: dict[str, float]) -> float:
    """Work that contacts took up (J) less all that is known of it: stored, dissipated, and booked at re-detection."""
    known = ("elastic_contacts", "fracture_mode_1", "fracture_mode_2", "friction", "dashpot", "redetection", "area")
    return terms["contact_work"] - sum(terms.get(key, 0.0) for key in known)
