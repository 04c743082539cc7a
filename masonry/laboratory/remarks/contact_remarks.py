"""What a user should know of the numbers given for contacts: where one of them does not do what it says."""

from math import inf

import numpy as np

from geometry.blocks import Joints
from masonry.assembly.assemble import Assembly
from masonry.configuration.energy import present
from masonry.laws.factory import properties_of
from masonry.laws.state import JointProperties
from masonry.model.large.meeting import Large
from masonry.monitors.stability import smallest_block
from masonry.rows.history import Frame
from masonry.scene.tables.contact import Contact
from masonry.scene.tables.loading import Drive

REACH = 0.9
"""Share of the way from the middle of a joint to its corners from which on contact points count as at its edge."""
LIFTED = 1e-3
"""Share of the largest opening or closing of all contacts from which on one is open."""
STAYS = 1e-3
"""Of the smallest block: where none has moved by more, joints hardly open, and what they do while closed decides."""


def contact_remarks(assembly: Assembly) -> list[str]:
    """One line for each number that is cut, or that nothing can come of in this specimen."""
    model, found = assembly.model, []
    for name, joint in zip(model.group_names, model.groups.properties, strict=True):
        given = assembly.scene.contact_of(name)
        reads = "tensile_strength" in properties_of(given.law)
        if reads and joint.tensile_strength is not None and np.ndim(joint.tensile_strength) == 0:
            found += _of_tension(name, given, joint, smallest_block(model))
        if given.dilation_angle and given.law == "friction":
            found.append(
                f"contact.{name}.dilation_angle: law 'friction' does not dilate; take law = \"brittle\" with a tensile "
                "strength and a cohesion of 0 Pa, and give dilation_cutoff"
            )
        if joint.tan_dilation is not None:
            found += _of_dilation(name, given, joint, travel_of(assembly.scene.drive), model.large)
    return found


def rocking_remarks(assembly: Assembly) -> list[str]:
    """Of joints that may rock: the lever arm that their contact points leave of that to the edge."""
    rotates = _may_rotate(assembly)
    joints = assembly.joints
    return _of_rocking(assembly, rotates[joints.block_a] | rotates[joints.block_b], "turn, where they rock,")


def rocked_remarks(assembly: Assembly, frames: list[Frame]) -> list[str]:
    """The same of joints that were open on one side and pressed on the other in one of these frames."""
    patch = assembly.joints.patch
    rocked = np.zeros(len(patch), dtype=bool)
    for frame in frames:
        pressed = frame.normal_stress < 0.0
        apart = frame.opening > LIFTED * float(np.abs(frame.opening).max(initial=0.0))
        rocked |= _in_joints_of(patch, pressed, apart)
    return _of_rocking(assembly, rocked, "opened on one side and turn")


def closed_remarks(assembly: Assembly, frames: list[Frame]) -> list[str]:
    """One line where no block has moved by more than STAYS in any of these frames, and patches have points at their
    corners, which the scene has not chosen."""
    model = assembly.model
    if model.large is None or assembly.scene.specimen.patch_points is not None:
        return []
    farthest = max(float(np.abs(frame.corners).max(initial=0.0)) for frame in frames) if frames else 0.0
    if farthest > STAYS * smallest_block(model) or not any(is_dry(assembly, g) for g in range(len(model.group_names))):
        return []
    return [
        "no block moved by more than a thousandth of its size, so that dry joints decide which stay closed: with "
        "points at their corners alone these bend three times as stiff as their pressure does; take "
        'specimen.patch_points = "spread", or say "corners" where that does not matter'
    ]


def _in_joints_of(patch: np.ndarray, some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """(C,) which contacts lie in joint faces that have points of both kinds."""
    return np.isin(patch, patch[some]) & np.isin(patch, patch[others])


def is_dry(assembly: Assembly, g: int) -> bool:
    """Whether the joints of a contact group have no tension."""
    law = assembly.scene.contact_of(assembly.model.group_names[g]).law
    strength = assembly.model.groups.properties[g].tensile_strength
    return law == "friction" or ("tensile_strength" in properties_of(law) and not np.any(strength))


def _of_rocking(assembly: Assembly, which: np.ndarray, what: str) -> list[str]:
    """One line for each group with joints, among these contacts (C,), that neither pull nor have points at the edge."""
    model, found, reach = assembly.model, [], _reach(assembly.joints)
    for g, (name, joint) in enumerate(zip(model.group_names, model.groups.properties, strict=True)):
        mine = which & (model.group == g)
        if not (is_dry(assembly, g) and joint.tan_friction and mine.any()):
            continue
        if (least := float(reach[mine].min())) > REACH:
            continue
        found.append(
            f"contact.{name}: joints without tension {what} about their outermost contact points, which reach "
            f'{least:.2g} of the way from the middle to the corners: take specimen.contact_points = "vertex"'
        )
    return found


def _reach(joints: Joints) -> np.ndarray:
    """(C,) how far the points of the same joint face lie from its middle, over how far its corners do."""
    count = len(joints.patch_start) - 1
    weight = np.bincount(joints.patch, joints.area, count)
    sums = [np.bincount(joints.patch, joints.area * along, count) for along in joints.point.T]
    middle = np.stack(sums, axis=1) / np.maximum(weight, 1e-300)[:, None]
    of_corner = np.repeat(np.arange(count), np.diff(joints.patch_start))
    inner, outer = np.zeros(count), np.zeros(count)
    np.maximum.at(inner, joints.patch, np.linalg.norm(joints.point - middle[joints.patch], axis=1))
    np.maximum.at(outer, of_corner, np.linalg.norm(joints.patch_points - middle[of_corner], axis=1))
    return (inner / np.maximum(outer, 1e-300))[joints.patch]


def _may_rotate(assembly: Assembly) -> np.ndarray:
    """(B,) which blocks are free to rotate about some axis."""
    model, rotates = assembly.model, np.zeros(assembly.specimen.blocks.count, dtype=bool)
    for kind, body in present(model):
        if kind == "tets":
            rotates[model.layout.members[kind]] = True
        else:
            rotates[model.layout.members[kind]] = np.any(body.dt_over_mass[:, 3:] > 0.0, axis=1)
    return rotates


def _of_tension(name: str, given: Contact, joint: JointProperties, block: float) -> list[str]:
    """Tensile strength beyond the apex of the Coulomb line, or so low that no opening takes the cohesion."""
    wanted, has = given.tensile_strength or 0.0, float(joint.tensile_strength or 0.0)
    where = f"contact.{name}.tensile_strength"
    if wanted > 0.0 and has == 0.0 and given.cohesion:
        return [f"{where} = {wanted:g} Pa is less than 1e-5 of the cohesion of {given.cohesion:g} Pa: it is taken as 0"]
    if has < wanted:
        return [
            f"{where} = {wanted:g} Pa is beyond the apex of the Coulomb line, cohesion / tan(friction angle) = "
            f"{has:.6g} Pa, where a slip meets no resistance: tension is cut there"
        ]
    if has > 0.0 and (given.fracture_energy_mode_1 or 0.0) / has > block:
        return [
            f"{where}: at {has:g} Pa the fracture energy of mode I keeps the joint together over an opening of "
            f"{(given.fracture_energy_mode_1 or 0.0) / has:.3g} m, more than a block: lower that energy too, or take "
            "0 Pa for a joint that comes apart at once"
        ]
    return []


def _of_dilation(name: str, given: Contact, joint: JointProperties, travel: float, large: Large | None) -> list[str]:
    """A dilation that ends before its given slip, or not within the travel of the drive, though no end was given."""
    end = float(np.max(joint.dilation_cutoff)) if joint.dilation_cutoff is not None else inf
    if large is not None and (most := float(large.near.search.skin[0])) < end:
        return [
            f"contact.{name}: in large displacement faces without strength that have slid {1e3 * most:.3g} mm are "
            "found anew where they touch, and dilate no more: what slides further may fall too early; give a "
            "dilation_cutoff below that"
        ]
    if given.dilation_cutoff is not None or end <= travel:
        return []
    return [
        f"contact.{name}: dilation does not end within the drive's {1e3 * travel:.3g} mm: by its fracture energy the "
        f"cohesion is gone at a slip of {1e3 * end:.3g} mm only; give dilation_cutoff, or less fracture energy"
    ]


def travel_of(drive: Drive | None) -> float:
    """m, the whole travel of a drive, to and fro; without one nothing is known, and all is within it."""
    return inf if drive is None else float(np.abs(np.diff(drive.reversals, prepend=0.0)).sum())
