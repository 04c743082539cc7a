"""Which pace a plan asks for."""

from masonry.loading.adaptive import AdaptiveLoading
from masonry.loading.rest import Rest
from masonry.loading.scheduled import ScheduledLoading
from masonry.loading.varying_loads import VaryingLoading
from masonry.model.loads import Controlled, Program
from masonry.model.model import Model

Pace = ScheduledLoading | AdaptiveLoading


def pace_of(model: Model, plan: Program | Controlled, rows: int) -> Pace:
    """The pace that a plan asks for."""
    if isinstance(plan, Program):
        if plan.varying is not None:
            return VaryingLoading(model, plan, plan.varying, rows)
        return ScheduledLoading(plan, rows, Rest(model) if model.scaled and model.damping is not None else None)
    return AdaptiveLoading(model, plan, rows)
