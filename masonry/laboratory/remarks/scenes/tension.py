"""Does a tensile strength do what its number says? Beyond the apex of the Coulomb line nothing holds a slip, and it is
cut there; next to nothing it is taken as 0; and a fracture energy too large for it holds a joint together for ever.

The limits are those of the laws (`masonry/laws/building/factory.py`), and the size of the smallest block.
"""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt
from masonry.laws.building.factory import NOTHING, properties_of
from masonry.laws.state import JointProperties
from masonry.monitors.stability import smallest_block
from masonry.scene.tables.contact_group import Contact


def doubts(assembly: Assembly) -> list[Doubt]:
    """One at most for each contact group whose strength does not scatter."""
    model, raised = assembly.model, []
    for name, joint in zip(model.group_names, model.groups.properties, strict=True):
        contact = assembly.scene.contact_of(name)
        if "tensile_strength" not in properties_of(contact.law):
            continue
        if joint.tensile_strength is not None and np.ndim(joint.tensile_strength) == 0:
            raised += of_group(f"contact.{name}.tensile_strength", contact, joint, smallest_block(model))
    return raised


def of_group(key: str, contact: Contact, joint: JointProperties, block: float) -> list[Doubt]:
    """Of the strength that a scene gives and the one that a joint has (Pa); the size of the smallest block (m)."""
    wanted, has = contact.tensile_strength or 0.0, float(joint.tensile_strength or 0.0)
    energy = contact.fracture_energy_mode_1 or 0.0
    if wanted > 0.0 and has == 0.0 and contact.cohesion:
        sentence = (
            f"{key} = {wanted:g} Pa is less than 1e-5 of the cohesion of {contact.cohesion:g} Pa: it is taken as 0"
        )
        return [Doubt("tension_left_out", wanted, NOTHING * contact.cohesion, sentence)]
    if has < wanted:
        sentence = (
            f"{key} = {wanted:g} Pa is beyond the apex of the Coulomb line, cohesion / tan(friction angle) = {has:.6g} "
            "Pa, where a slip meets no resistance: tension is cut there"
        )
        return [Doubt("tension_cut", wanted, has, sentence)]
    if has > 0.0 and energy / has > block:
        sentence = (
            f"{key}: at {has:g} Pa the fracture energy of mode I keeps the joint together over an opening of "
            f"{energy / has:.3g} m, more than a block"
        )
        advice = "lower that energy too, or take 0 Pa for a joint that comes apart at once"
        return [Doubt("tough_joint", energy / has, block, sentence, advice)]
    return []
