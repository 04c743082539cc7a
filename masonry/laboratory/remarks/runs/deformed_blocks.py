"""Did blocks deform beyond what their elastic law and the proof of the time step allow?"""

from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.inspection import Inspection


def doubts(inspection: Inspection) -> list[Doubt]:
    """Of all rows."""
    return [Doubt("deformation", None, None, line) for line in inspection.outcome.found.get("deformation", [])]
