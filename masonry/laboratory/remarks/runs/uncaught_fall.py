"""Did blocks fall off shaken ground that has no floor? They go on falling, and so do gauges on them: the first fall is
a result, what is read after it is not.

Asked of shaken scenes in large displacement without [floor].
"""

from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import Doubt
from masonry.monitors.collapse import Fallen

ADVICE = "add an empty [floor], and a table [contact.default] or those of the groups that may fall on it"


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    scene, fallen = inspection.assembly.scene, inspection.outcome.records.get(Fallen)
    if not scene.ground or not scene.is_large or scene.floor is not None or fallen is None:
        return []
    sentence = "blocks fell, and no floor catches them: what gauges read after the first fall is their way down"
    return [Doubt("uncaught_fall", 0.0, None, sentence, ADVICE)]
