"""Advice on contact points by which joints that stay closed bend too stiffly."""

from masonry.assembly.assemble import Assembly


def advice_for(assembly: Assembly) -> str:
    """Of a scene with its points at edges, or on the nodes of a mesh."""
    joints = assembly.joints
    if (joints.node_a >= 0).any() or (joints.node_b >= 0).any():
        return "take a smaller specimen.mesh_size, as their contact points are the nodes of the mesh"
    if assembly.scene.contact_points == "vertex":
        return "take specimen.points_per_edge = 4, or 3 at least"
    return 'take specimen.contact_points = "gauss" with 2 points per edge or more'
