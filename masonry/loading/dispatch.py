"""Which pace a plan asks for."""

from masonry.loading.adaptive import ControlledPace
from masonry.loading.cyclic_adaptive import CyclicPace
from masonry.loading.rest import Rest
from masonry.loading.schedule import Cyclic
from masonry.loading.scheduled import FixedPace
from masonry.loading.varying_loads import VaryingPace
from masonry.model.loads import Controlled, Program
from masonry.model.model import Model

Pace = FixedPace | ControlledPace


def pace_of(model: Model, plan: Program | Controlled, rows: int) -> Pace:
    """The pace that a plan asks for."""
    if isinstance(plan, Program):
        if plan.varying is not None:
            return VaryingPace(model, plan, plan.varying, rows)
        return FixedPace(plan, rows, Rest(model) if model.scaled and model.damping is not None else None)
    return CyclicPace(model, plan, rows) if isinstance(plan, Cyclic) else ControlledPace(model, plan, rows)
