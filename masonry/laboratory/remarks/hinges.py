"""Doubt and advice on joints that bear no moment about their one row of contact points."""

from masonry.assembly.assemble import Assembly
from masonry.estimates.hinged_joints import Hinges, free_to_turn
from masonry.estimates.joint_faces import Faces
from masonry.judgement.doubt import POINTS, Doubt

ENOUGH = 4
"""Points along an edge that are proposed; a run with them says whether these do."""


def free_hinges(assembly: Assembly, faces: Faces, hinges: Hinges) -> list[Doubt]:
    """One for each contact group with such joints between blocks that may turn about them; of dry ones `rocking` of
    `edge_reach.py` says so."""
    return [
        Doubt(
            "hinges",
            None,
            None,
            f"contact.{name}: {number} joint{'s have' if number > 1 else ' has'} one row of contact points, and bear"
            f"{'s' if number == 1 else ''} no moment where blocks turn about it",
            more_points(assembly),
            POINTS,
        )
        for name, number in zip(assembly.model.group_names, free_to_turn(assembly, faces, hinges), strict=True)
        if number
    ]


def more_points(assembly: Assembly) -> str:
    """The key that the scene has taken for the number of points."""
    specimen = assembly.scene.specimen
    if specimen.points_per_face is not None:
        return f"take specimen.points_per_face = {ENOUGH**2} or more"
    if specimen.contact_spacing is not None:
        return f"take a specimen.contact_spacing of 1/{ENOUGH} of the edges, or less"
    return f"take specimen.points_per_edge = {ENOUGH} or more"
