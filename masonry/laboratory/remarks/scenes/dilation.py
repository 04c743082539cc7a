"""Does dilation do what its numbers say? It may end before its cut-off, never end, or have a law that has none.

In large displacement faces without strength are detected anew after a slip of the skin of the search, and dilate no
more. Without a cut-off dilation ends where the cohesion is gone, which should be within the travel of the drive.
"""

from math import inf

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.configuration.configuration import configuration_of
from masonry.judgement.doubt import Doubt
from masonry.laws.state import JointProperties
from masonry.scene.tables.contact_group import Contact
from masonry.scene.tables.loads_and_supports import Drive


def doubts(assembly: Assembly) -> list[Doubt]:
    """One at most for each contact group."""
    model, raised = assembly.model, []
    for name, joint in zip(model.group_names, model.groups.properties, strict=True):
        contact = assembly.scene.contact_of(name)
        if contact.dilation_angle and contact.law == "friction":
            sentence = f"contact.{name}.dilation_angle: law 'friction' does not dilate"
            advice = 'take law = "brittle" with a tensile strength and a cohesion of 0 Pa, and give dilation_cutoff'
            raised.append(Doubt("no_dilation", None, None, sentence, advice))
        if joint.tan_dilation is not None:
            raised += of_group(
                name, contact, joint, travel_of(assembly.scene.drive), configuration_of(model).patches.skin
            )
    return raised


def of_group(name: str, contact: Contact, joint: JointProperties, travel: float, skin: float) -> list[Doubt]:
    """A dilation that ends before its slip, or that does not end within the travel (m) of the drive; skin (m) of the
    search, infinite where nothing is detected anew."""
    end = float(np.max(joint.dilation_cutoff)) if joint.dilation_cutoff is not None else inf
    if skin < end:
        sentence = (
            f"contact.{name}: in large displacement faces without strength that have slid {1e3 * skin:.3g} mm are "
            "detected anew, and dilate no more: what slides further may fall too early"
        )
        return [Doubt("dilation_lost", end, skin, sentence, "give a dilation_cutoff below that")]
    if contact.dilation_cutoff is not None or end <= travel:
        return []
    sentence = (
        f"contact.{name}: dilation does not end within the drive's {1e3 * travel:.3g} mm: by its fracture energy the "
        f"cohesion is gone at a slip of {1e3 * end:.3g} mm only"
    )
    return [Doubt("endless_dilation", end, travel, sentence, "give dilation_cutoff, or less fracture energy")]


def travel_of(drive: Drive | None) -> float:
    """m, the whole travel of a drive, to and fro; without one nothing is known, and all is within it."""
    return inf if drive is None else float(np.abs(np.diff(drive.reversals, prepend=0.0)).sum())
