"""Joints without tension: which groups have none, and how near to their edges their contact points reach."""

import numpy as np

from geometry.blocks import Joints
from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt
from masonry.laws.building.factory import properties_of

REACH = 0.9
"""Share of the way from the middle of a joint to its corners: contact points that reach less far leave a lever arm that
is too short, by which a block rocks too early."""

MORE = "take specimen.points_per_edge = 6 or more, as an edge that may crush needs points beside it too"


def is_dry(assembly: Assembly, g: int) -> bool:
    """Whether the joints of a contact group have no tension."""
    law = assembly.scene.contact_of(assembly.model.group_names[g]).law
    strength = assembly.model.groups.properties[g].tensile_strength
    return law == "friction" or ("tensile_strength" in properties_of(law) and not np.any(strength))


def points_are_chosen(assembly: Assembly) -> bool:
    """Whether patches have points where the scene wants them, or more of them as they may crush."""
    return assembly.scene.specimen.chooses_patch_points or assembly.model.state.crushed is not None


def rocking(assembly: Assembly, which: np.ndarray, what: str) -> list[Doubt]:
    """One for each group with joints, among these contacts (C,), that neither pull nor have points at the edge."""
    model, raised, reach = assembly.model, [], _reach(assembly.joints)
    for g, (name, joint) in enumerate(zip(model.group_names, model.groups.properties, strict=True)):
        mine = which & (model.group == g)
        if not (is_dry(assembly, g) and joint.tan_friction and mine.any()):
            continue
        if (least := float(reach[mine].min())) > REACH:
            continue
        sentence = (
            f"contact.{name}: joints without tension {what} about their outermost contact points, and these reach "
            f"{least:.2g} of the way from the middle to the corners"
        )
        crushes = assembly.scene.contact_of(name).crushing is not None
        raised.append(
            Doubt("rocking", least, REACH, sentence, MORE if crushes else 'take specimen.contact_points = "vertex"')
        )
    return raised


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
