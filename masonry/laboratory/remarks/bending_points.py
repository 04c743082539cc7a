"""Advice on contact points by which joints bend or twist otherwise than their areas do."""

from masonry.assembly.assemble import Assembly

SPREAD = 'take specimen.patch_points = "spread", or say "corners" where that does not matter'
"""Of patches with points at their corners alone."""
ON_NODES = "take a smaller specimen.mesh_size, as their contact points are the nodes of the mesh"
"""Of joints of meshed blocks."""


def advice_for(assembly: Assembly) -> str:
    """Of a scene with its points at edges, or on the nodes of a mesh."""
    joints = assembly.joints
    if (joints.node_a >= 0).any() or (joints.node_b >= 0).any():
        return ON_NODES
    if assembly.scene.contact_points == "vertex":
        return "take specimen.points_per_edge = 4, or 3 at least"
    return 'take specimen.contact_points = "gauss" with 2 points per edge or more'


def points_are_chosen(assembly: Assembly) -> bool:
    """Whether patches have points where the scene wants them, or more of them as they may crush."""
    return assembly.scene.specimen.chooses_patch_points or assembly.model.crushes
