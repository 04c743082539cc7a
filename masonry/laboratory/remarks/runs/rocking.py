"""Did joints without tension rock about points within their edges? Such a block has too short a lever arm.

Of a run that is made for a strength few_points says what that makes of it.
"""

from masonry.estimates.inspection import Inspection
from masonry.estimates.rocking_edges import reach_where_rocked
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.edge_reach import rocking


def doubts(inspection: Inspection) -> list[Doubt]:
    """One for each contact group."""
    if inspection.is_for_strength:
        return []
    reach = reach_where_rocked(inspection)
    return rocking(inspection.assembly, inspection.faces, reach, "opened on one side and turn")
