"""Friction without dilation, with points at the corners of joints alone: a joint turns three times as stiffly on them
as on its area, and how stiffly joints turn decides what presses each of them. So the same path of the load is followed
with three points along each edge as well, which have the second moments of a joint exactly.
"""

from masonry.assembly.assemble import joined
from masonry.limit_analysis.contact_strengths import contacts_of, mean_stiffness
from masonry.limit_analysis.element_limits import with_elements
from masonry.limit_analysis.limit_data import LimitData
from masonry.limit_analysis.limit_loads import Loads
from masonry.scene.tables.point_counts import PerAxis
from masonry.statics.no_dilation import Flat, without_dilation
from masonry.statics.problem import RigidContacts
from masonry.statics.solve import ANY, UPWARD, Method, Range
from masonry.statics.tilted import tilt_without_dilation

TOLD, MOST = 0.005, 2000
"""Share of a factor from which on a difference is told: runs come as near; contact points up to which it is asked."""
THREE = {
    "contact_points": "vertex",
    "points_per_edge": PerAxis(3, 3, 3),
    "points_per_face": None,
    "contact_spacing": None,
}
WORDS = "--points scene --set specimen.contact_points=vertex --set specimen.points_per_edge=3"


def followed(loads: Loads, contacts: RigidContacts, method: Method) -> Flat:
    """The end of the path of a load, where what slides does not rise."""
    if loads.steady is None:
        return without_dilation(loads.bodies, contacts, method, range_of(loads))
    return tilt_without_dilation(loads.bodies, contacts, loads.steady, method, range_of(loads))


def range_of(loads: Loads) -> Range:
    """What a drive pushes with may have any sign; other loads grow from nothing."""
    return UPWARD if loads.bodies.together is None else ANY


def say_of_corners(result: LimitData, loads: Loads, method: Method, factor: float, strength: bool) -> None:
    """A word where a factor by points at corners alone is another one with three points along each edge, or where that
    was not asked, as it takes long."""
    specimen = result.scene.specimen.model_copy(update=THREE)
    scene = result.scene.model_copy(update={"specimen": specimen})
    blocks, joints = joined(scene)
    if len(joints.area) > MOST:
        result.remarks.append(
            "joints have points at their corners alone, which turn three times as stiffly as their areas do; what that "
            f"makes of the factor was not asked, as it takes long: {WORDS} tells"
        )
        return
    contacts = contacts_of(scene, blocks, joints, strength)
    stiffness = mean_stiffness(scene, blocks, joints)
    contacts = with_elements(contacts, result.elements, loads.bodies, stiffness)
    three = followed(loads, contacts, method).solution
    more = three.factor / factor - 1.0 if three.status == "solved" and factor > 0.0 else 0.0
    if abs(more) > TOLD:
        difference = f"{three.factor:.5g} {result.unit}".rstrip() + f", {100.0 * abs(more):.2g} %"
        result.remarks.append(
            "joints have points at their corners alone, which turn three times as stiffly as their areas do: with "
            f"three along each edge the factor is {difference} {'more' if more > 0.0 else 'less'}; "
            f"{WORDS} gives all of it"
        )
