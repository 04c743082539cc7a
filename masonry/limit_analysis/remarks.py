"""Remarks beside the numbers of a limit analysis: assumptions, kind of the number, points to mind."""

import numpy as np

from geometry.blocks import Joints, Specimen
from masonry.errors import SceneError
from masonry.limit_analysis.contact_strengths import crushing_strengths, rises, sliding_fraction, strong_groups
from masonry.limit_analysis.limit_data import LimitData, set_of
from masonry.scene import Scene
from masonry.statics.jammed import jammed
from masonry.statics.problem import STEEP, RigidBodies, RigidContacts, Solution
from masonry.statics.solve import Method

RIGID = "rigid blocks, and joints that dilate by their friction angle as they slide"
LASTS = "; cohesion and tension last however far a crack opens"
FLAT = "rigid blocks, and joints that slide without dilating"
GREATEST = "the greatest under these assumptions; where they do not hold, it may fall earlier"
PYRAMIDS = "within pyramids in place of friction cones; where the assumptions do not hold, it may fall earlier"
PLASTIC = "no bound: it falls earlier if strength is lost as cracks open"
NO_BOUND = "no bound: friction without dilation, as joints of one stiffness come to it from the dead loads"
SLIDES = 0.01
"""Share of the work of the loads that shear forces must do for a word on dilation."""
CLOSED = 1e-6
"""Duality gap, and what is left on a block over its own loads, beyond which a word is said."""
USELESS = 0.01
"""What is left on a block over its own loads, beyond which there is no answer."""


def say_what_it_is(result: LimitData, contacts: RigidContacts, method_word: str, dilation: bool) -> None:
    """The assumptions first, and what kind of number stands under them."""
    plastic = bool(contacts.cohesion.any() or contacts.tension[np.isfinite(contacts.tension) & ~contacts.is_link].any())
    result.assumed = (RIGID if dilation else FLAT) + (LASTS if plastic else "")
    exact = PYRAMIDS if "pyramids" in method_word else GREATEST
    result.bound = NO_BOUND if not dilation else PLASTIC if plastic else exact


def scene_remarks(
    scene: Scene, specimen: Specimen, joints: Joints, contacts: RigidContacts, strength: bool, crushes: bool,
    other: str = "",
) -> list[str]:  # fmt: skip
    """Differences between the assumptions of a limit analysis and the scene.

    other: words of the command that --crushing does not go with
    """
    remarks = []
    elastic, strong = strong_groups(scene, specimen, joints)
    if elastic:
        remarks.append(f"joints of {', '.join(elastic)} are elastic: they bear any force, as they do in a run")
    if strong and strength:
        remarks.append(
            f"cohesion and tension of {', '.join(strong)} are taken as plastic strengths on the areas of the contact "
            "points: they last however far a crack opens, which mortar does not; --no-strength leaves them out"
        )
    if not strength:
        remarks.append("without cohesion and tension, with the friction that is left once they are gone")
    crushing = {} if crushes else crushing_strengths(scene, specimen, joints)
    if crushing:
        pulls = contacts.tension[~contacts.is_link & np.isfinite(contacts.tension)].any()
        more = " with --no-strength" * bool(pulls and strength) + f", without {other}" * bool(other)
        remarks.append(
            f"joints of {', '.join(crushing)} crush in a run, and bear any pressure here: it may fall earlier; "
            f'--crushing "{min(crushing.values()) * 1e-6:g} MPa"{more} takes that as a plastic strength'
        )
    if any(scene.deforms(g) for g in specimen.blocks.groups):
        remarks.append("every block is taken as rigid")
    if scene.scatter is not None:
        remarks.append("the scatter of strengths is left out: means count")
    if (steepest := float(contacts.friction.max(initial=0.0))) > STEEP:
        remarks.append(f"a tangent of friction of {steepest:g} is taken as {STEEP:g}: more cannot be reckoned with")
    return remarks


def say_of_sliding(
    result: LimitData, bodies: RigidBodies, contacts: RigidContacts, mechanism: Solution, cones: bool = True
) -> None:
    """A word where a mechanism slides, and rises by that in limit analysis but not in the scene."""
    slides = sliding_fraction(bodies, contacts, mechanism) > SLIDES
    if slides and not rises(result.scene, result.specimen, result.joints):
        result.remarks.append(
            "joints slide in this mechanism, and rise as they slide; in this scene they do not, or rise less, so that "
            f"it may fall earlier: --no-dilation{'' if cones else ', without --linear,'} tells"
        )


def say_of_slack(result: LimitData) -> None:
    """A word among the assumptions where elements bear a force that have slack to take up first."""
    forces = [result.normal, *(element.force for element in result.elements)]
    threshold = CLOSED * float(np.abs(np.concatenate(forces)).max(initial=0.0))
    result.assumed += "".join(element.on_slack for element in result.elements if element.bears_in_slack(threshold))


def say_of_jams(result: LimitData, bodies: RigidBodies, contacts: RigidContacts, method: Method) -> None:
    """A word where something stands under its dead loads only if it is jammed."""
    if (mechanism := jammed(bodies, contacts, method)) is not None:
        first = int(np.argmax(np.linalg.norm(mechanism.velocity[:, :3], axis=1)))
        result.remarks.append(
            f"{block_words(result.specimen, bodies, first)} stands only if it is jammed: joints can press against each "
            "other there without any load, and friction is reckoned with that holds it; a run decides"
        )


def say_how_exact(result: LimitData, bodies: RigidBodies) -> None:
    """Words on the gap, and on the block that is balanced worst. Raises SceneError where that one is not."""
    if result.gap > CLOSED:
        result.remarks.append(f"the duality gap is more than {CLOSED:g}: take no more digits of the factor than it has")
    if result.unbalance > CLOSED:
        block = block_words(result.specimen, bodies, result.worst)
        if result.unbalance > USELESS:
            raise SceneError(
                f"no answer: {block} is balanced only to {result.unbalance:.1g} of its own loads, as blocks or forces "
                "differ too much in size; leave out what is so small, or analyse it alone"
            )
        result.remarks.append(
            f"{block} is balanced only to {result.unbalance:.1g} of its own loads: the factor may be off by as much"
        )


def block_words(specimen: Specimen, bodies: RigidBodies, block: int) -> str:
    """A block by its number, a set that it is in, and its place."""
    name = set_of(specimen, block)
    where = ", ".join(f"{x:.4g}" for x in bodies.centre[block])
    return f"block {block}" + (f" ('{name}')" if name else "") + f" at ({where}) m"
