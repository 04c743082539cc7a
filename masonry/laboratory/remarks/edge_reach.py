"""Doubt and advice on joints without tension whose contact points do not reach to their edges."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.estimates.joint_faces import Faces, dry_groups
from masonry.judgement.doubt import POINTS, Doubt

REACH = 0.9
"""Share of the way from the middle of a joint to the edge about which it turns: contact points that reach less far
leave a lever arm that is too short, by which a block rocks too early."""

AT_EDGES = 'take specimen.contact_points = "vertex"'
MORE = "take specimen.points_per_edge = 6 or more, as an edge that may crush needs points beside it too"


def rocking(assembly: Assembly, faces: Faces, reach: np.ndarray, what: str) -> list[Doubt]:
    """One for each group with faces that neither pull nor have points at the edge about which they turn.

    reach  (J,) of each face, infinite where it is not asked
    """
    model, dry, raised = assembly.model, dry_groups(assembly), []
    for g, (name, joint) in enumerate(zip(model.group_names, model.groups.properties, strict=True)):
        least = float(reach[faces.group == g].min(initial=np.inf))
        if not (dry[g] and joint.tan_friction) or least > REACH:
            continue
        sentence = (
            f"contact.{name}: joints without tension {what} about their outermost contact points, and these reach "
            f"{least:.2g} of the way from the middle to the edge"
        )
        crushes = assembly.scene.contact_of(name).crushing is not None
        raised.append(Doubt("rocking", least, REACH, sentence, MORE if crushes else AT_EDGES, POINTS))
    return raised
