"""Dashpots in contacts of the undeformed shape, as far as they answer for themselves."""

from masonry.elements.element import Element
from masonry.model.element_plan import ElementPlan
from masonry.model.model import Model
from masonry.rows.columns import DASHPOT


class ContactDashpots(Element):
    """Those of a model, where it has any."""

    name = "contact_dashpots"

    def __init__(self, model: Model) -> None:
        super().__init__(ElementPlan())
        self.model = model

    def taken(self) -> dict[str, float]:
        dashpots = self.model.dashpots
        return {} if dashpots is None else {DASHPOT: float(self.model.joints.area @ dashpots.taken)}
