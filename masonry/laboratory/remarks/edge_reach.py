"""Joints without tension: which groups have none, and how near to their edges their contact points reach."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.estimates.joint_faces import Faces, corners_of
from masonry.judgement.doubt import Doubt
from masonry.laws.building.factory import properties_of

REACH = 0.9
"""Share of the way from the middle of a joint to the edge about which it turns: contact points that reach less far
leave a lever arm that is too short, by which a block rocks too early."""

MORE = "take specimen.points_per_edge = 6 or more, as an edge that may crush needs points beside it too"


def is_dry(assembly: Assembly, g: int) -> bool:
    """Whether the joints of a contact group have no tension."""
    law = assembly.scene.contact_of(assembly.model.group_names[g]).law
    strength = assembly.model.groups.properties[g].tensile_strength
    return law == "friction" or ("tensile_strength" in properties_of(law) and not np.any(strength))


def points_are_chosen(assembly: Assembly) -> bool:
    """Whether patches have points where the scene wants them, or more of them as they may crush."""
    return assembly.scene.specimen.chooses_patch_points or assembly.model.crushes


def rocking(assembly: Assembly, faces: Faces, reach: np.ndarray, what: str) -> list[Doubt]:
    """One for each group with faces that neither pull nor have points at the edge about which they turn.

    reach  (J,) of each face, infinite where it is not asked
    """
    model, raised = assembly.model, []
    for g, (name, joint) in enumerate(zip(model.group_names, model.groups.properties, strict=True)):
        least = float(reach[faces.group == g].min(initial=np.inf))
        if not (is_dry(assembly, g) and joint.tan_friction) or least > REACH:
            continue
        sentence = (
            f"contact.{name}: joints without tension {what} about their outermost contact points, and these reach "
            f"{least:.2g} of the way from the middle to the edge"
        )
        crushes = assembly.scene.contact_of(name).crushing is not None
        raised.append(
            Doubt("rocking", least, REACH, sentence, MORE if crushes else 'take specimen.contact_points = "vertex"')
        )
    return raised


def reach_along(faces: Faces, face: int, along: np.ndarray) -> float:
    """How far the points of a face lie from its middle towards the edge about which it turns, over how far its corners
    do; it opens along directions (D, 3), of which the least counts. Infinite without any."""
    inner = -(faces.arm[faces.contacts(face)] @ along.T).min(axis=0)
    outer = -((corners_of(faces, face) - faces.middle[face]) @ along.T).min(axis=0)
    ahead = outer > 0.0
    return float((inner[ahead] / outer[ahead]).min(initial=np.inf))
