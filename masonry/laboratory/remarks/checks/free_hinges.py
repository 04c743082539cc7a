"""May blocks turn about joints with one row of contact points? A run says what that makes of its strength."""

from masonry.assembly.assemble import Assembly
from masonry.estimates.hinged_joints import hinges_of
from masonry.estimates.joint_faces import faces_of
from masonry.laboratory.remarks.hinges import free_hinges


def remarks(assembly: Assembly) -> list[str]:
    """A line for each contact group with such joints."""
    faces = faces_of(assembly)
    return [doubt.line for doubt in free_hinges(assembly, faces, hinges_of(assembly, faces))]
