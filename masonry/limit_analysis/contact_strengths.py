"""The contact points of a limit analysis, and what each of them can bear, from the contact tables of a scene."""

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.polyhedra.measures import moments
from masonry.assembly.assemble import joined, require_contact_groups
from masonry.errors import SceneError
from masonry.laws.building.factory import made
from masonry.model.contact_groups import contact_groups
from masonry.scene import Scene
from masonry.scene.tables.point_counts import PerAxis
from masonry.statics.crushing import crushing_of
from masonry.statics.problem import RigidBodies, RigidContacts, Solution

POINTS = ("corners", "scene")
DILATES = 0.99
"""Tangent of the dilation angle over that of the friction angle from which they are the same."""
LASTS = 0.02
"""Slip, over the size of the smallest block, to which joints must rise: walls with openings move by as much before they
fall."""
CORNERS = {
    "contact_points": "vertex",
    "points_per_edge": PerAxis(),
    "points_per_face": None,
    "contact_spacing": None,
}
"""What a specimen says of its contact points where they are the corners of its joints."""


def touching(scene: Scene, points: str = "corners") -> tuple[Specimen, Joints]:
    """The blocks of a scene and its joints, with points at the corners of the joints or where the scene has them."""
    if points == "corners":
        scene = scene.model_copy(update={"specimen": scene.specimen.model_copy(update=CORNERS)})
    return joined(scene)


def contacts_of(
    scene: Scene, specimen: Specimen, joints: Joints, strength: bool = True, crushing: float | None = None
) -> RigidContacts:
    """Strength of each contact point: Coulomb friction; cohesion and tension on its area, as plastic strengths.

    strength  False leaves out cohesion and tension, and takes the friction that is left once they are gone
    crushing  Pa, compressive strength of all joints that are not elastic; needs points at the corners, no tension
    """
    require_contact_groups(scene, specimen, joints)
    names, group = contact_groups(specimen.blocks, joints)
    rows = np.array([_strengths(scene, name, strength) for name in names]).reshape(-1, 4)[group]
    solid = rows[:, 3] > 0.5
    crush = None
    if crushing is not None:
        if (rows[~solid, 2] > 0.0).any():
            raise SceneError("--crushing is for joints without tensile strength; add --no-strength")
        crush = crushing_of(joints, crushing, ~solid)
    return RigidContacts(
        *(joints.block_a, joints.block_b, joints.point, joints.normal, joints.patch, joints.area),
        *(rows[:, 0], rows[:, 1] * joints.area, rows[:, 2] * joints.area, solid, crush),
    )


def strong_groups(scene: Scene, specimen: Specimen, joints: Joints) -> tuple[list[str], list[str]]:
    """Groups of contacts that are elastic, and bear anything; and those that have cohesion or tensile strength."""
    names, _ = contact_groups(specimen.blocks, joints)
    strengths = {name: _strengths(scene, name, True) for name in names}
    elastic = [name for name, (_, _, tension, solid) in strengths.items() if solid or np.isinf(tension)]
    return elastic, [name for name in names if name not in elastic and any(strengths[name][1:])]


def crushing_strengths(scene: Scene, specimen: Specimen, joints: Joints) -> dict[str, float]:
    """By group of contacts that crush in a run, the compressive strength (Pa)."""
    names, _ = contact_groups(specimen.blocks, joints)
    tables = {name: scene.contact_of(name) for name in names}
    return {name: float(table.compressive_strength or 0.0) for name, table in tables.items() if table.crushing}


def mean_stiffness(scene: Scene, specimen: Specimen, joints: Joints) -> float:
    """Pa/m, the normal stiffness of the joints, as a mean over their area."""
    names, group = contact_groups(specimen.blocks, joints)
    each = [made(name, scene.contact_of(name).properties(scene.turns_back))[1].normal_stiffness for name in names]
    return float(np.average(np.array(each, dtype=float)[group], weights=joints.area)) if len(joints.area) else 1.0


def rises(scene: Scene, specimen: Specimen, joints: Joints) -> bool:
    """Whether all that slides in the scene rises by its friction angle, as it does in a limit analysis.

    Some rises end before anything falls: at a cut-off, or once a joint is torn where its opening stays.
    """
    names, _ = contact_groups(specimen.blocks, joints)
    tables = [made(name, scene.contact_of(name).properties(scene.turns_back))[1] for name in names]
    far = LASTS * float(np.min(moments(specimen.blocks)[0])) ** (1.0 / 3.0)
    for joint in tables:
        ends = joint.tan_dilation is not None and (joint.dilation_cutoff < far or joint.elastic_unloading is not None)
        if ends or (joint.tan_dilation or 0.0) < DILATES * (joint.tan_friction or 0.0):
            return False
    return True


def sliding_fraction(bodies: RigidBodies, contacts: RigidContacts, solution: Solution) -> float:
    """Work of shear forces on the slip of a mechanism, over the work of all loads on it; whatever its sign."""
    speeds = []
    for block in (contacts.block_a, contacts.block_b):
        arm = contacts.point - bodies.centre[block]
        speeds.append(solution.velocity[block, :3] + np.cross(solution.velocity[block, 3:], arm))
    work = np.abs((solution.shear * (speeds[1] - speeds[0])).sum(axis=1)).sum()
    loads = (np.abs(bodies.dead) + np.abs(solution.factor * bodies.live)) * np.abs(solution.velocity)
    return float(work / max(loads.sum(), 1e-300))


def _strengths(scene: Scene, group: str, strength: bool) -> tuple[float, float, float, float]:
    """Tangent of the friction angle, cohesion and tensile strength (Pa), and 1 where the contact bears any force."""
    _, joint = made(group, scene.contact_of(group).properties(scene.turns_back))
    if joint.tan_friction is None:  # elastic: it bears any force, or without shear stiffness any force across it
        return (0.0, 0.0, np.inf, 0.0) if joint.shear_stiffness == 0.0 else (0.0, 0.0, 0.0, 1.0)
    if not strength:
        return float(joint.tan_residual_friction or 0.0), 0.0, 0.0, 0.0
    return float(joint.tan_friction), float(joint.cohesion or 0.0), float(joint.tensile_strength or 0.0), 0.0
