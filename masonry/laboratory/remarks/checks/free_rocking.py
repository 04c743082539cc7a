"""May joints rock about points within their edges? A run says so of joints that did."""

from masonry.assembly.assemble import Assembly
from masonry.estimates.joint_faces import dry_groups, faces_of
from masonry.estimates.rocking_edges import reach_where_free
from masonry.laboratory.remarks.edge_reach import rocking


def remarks(assembly: Assembly) -> list[str]:
    """A line for each contact group with such joints."""
    if not len(assembly.joints.area) or not dry_groups(assembly).any():
        return []
    faces = faces_of(assembly)
    reach = reach_where_free(assembly, faces)
    return [doubt.line for doubt in rocking(assembly, faces, reach, "turn, where they rock,")]
