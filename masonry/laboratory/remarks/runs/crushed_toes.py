"""Are the patches of blocks that may crush too coarse for a toe? With two points, which stand for a quarter of a face
each, a toe may never come to its strength.

Patches of large displacement have ten points along an edge where blocks may crush. A scene that gives them fewer than
six is told so whatever happened. What few points make of joints whose edge crushed is a matter of few_points.
"""

from masonry.assembly.contact_pairs import points_along
from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import POINTS, Doubt

FEWEST = 6
"""Points along an edge of a patch that may crush."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    scene = inspection.assembly.scene
    if not scene.is_large or all(contact.crushing is None for contact in scene.contact.values()):
        return []
    along = points_along(scene, True)
    if along >= FEWEST or any(map(scene.is_meshed, scene.material)):  # each triangle of a mesh is a patch
        return []
    sentence = (
        f"patches of blocks that may crush have {along} points along each edge: these see a toe late, or never, "
        "and what it bears may be off by a third"
    )
    advice = "take specimen.patch_points_per_edge = 10, the default"
    return [Doubt("crushed_toes", 1.0 / along, 1.0 / FEWEST, sentence, advice, POINTS)]
