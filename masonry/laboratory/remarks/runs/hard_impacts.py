"""Did blocks fall on shaken ground where no impact loses energy? Without dashpots they bounce as long as friction lets
them: what lies still in a laboratory leaps on, and may knock down what stood.

Asked of shaken scenes in large displacement in which a block has fallen, or has left the floor.
"""

from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import Doubt
from masonry.monitors.collapse import Fallen, LeftFloor


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    scene, pairs, records = inspection.assembly.scene, inspection.assembly.pairs, inspection.outcome.records
    if not scene.ground or pairs is None or any(one.normal_dashpot for one in pairs.properties.values()):
        return []
    if records.get(Fallen) is None and records.get(LeftFloor) is None:
        return []
    sentence = "blocks fell, and no impact lost energy: what hits the ground bounces, and may knock down what stood"
    return [Doubt("hard_impacts", 0.0, None, sentence, "give contacts a restitution, or a normal_dashpot")]
