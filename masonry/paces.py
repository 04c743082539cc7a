"""Which pace a plan asks for."""

from masonry.cyclic_pace import CyclicPace
from masonry.cycling import Cyclic
from masonry.fixed_pace import FixedPace
from masonry.loads import Controlled, Program
from masonry.model import Model
from masonry.pace import ControlledPace
from masonry.rest import Rest
from masonry.varying_loads import VaryingPace

Pace = FixedPace | ControlledPace


def pace_of(model: Model, plan: Program | Controlled, rows: int) -> Pace:
    """The pace that a plan asks for."""
    if isinstance(plan, Program):
        if plan.varying is not None:
            return VaryingPace(model, plan, plan.varying, rows)
        return FixedPace(plan, rows, Rest(model) if model.scaled and model.damping is not None else None)
    return CyclicPace(model, plan, rows) if isinstance(plan, Cyclic) else ControlledPace(model, plan, rows)
