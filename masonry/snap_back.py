"""Where a law's curve may snap back under the compression that a run brings: looked at between chunks."""

import numpy as np

from masonry.errors import Stopped
from masonry.laws.door import beside
from masonry.model import Model


class SnapBack:
    """Stops a run in which a contact softens in shear under more compression than its law's energy is enough for.

    Beyond that compression the strength would drop at once and take more energy than the fracture energy given. A
    compression is looked at before and after the steps of a chunk, in which contacts soften.
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        self.limits = [
            find(shape, interface) if (find := beside(type(shape), "largest_compression")) else np.inf
            for shape, interface in zip(*model.groups[:2], strict=True)
        ]
        bounds = model.groups[3].astype(np.int64)
        self.spans = [slice(a, b) for a, b in zip(bounds[:-1], bounds[1:], strict=True)]
        self.before = [(self._compression(span), self._intact(span)) for span in self.spans]

    def check(self, step: int) -> None:
        """Raise Stopped, naming the contact, if one has softened beyond its limit since the last look."""
        for g, (limit, span) in enumerate(zip(self.limits, self.spans, strict=True)):
            if not np.isfinite(limit):
                continue
            compression, intact = self._compression(span), self._intact(span)
            most = np.where(intact < self.before[g][1], np.maximum(compression, self.before[g][0]), 0.0)
            self.before[g] = compression, intact
            if len(most) and most.max() > limit:
                self._stop(step, g, span.start + int(np.argmax(most)), float(most.max()))

    def _compression(self, span: slice) -> np.ndarray:
        """(c,) Pa of a group's contacts, from the force that acts."""
        _, normal, area, _, force = self.model.contacts
        return -np.einsum("ci,ci->c", force[span], normal[span]) / area[span]

    def _intact(self, span: slice) -> np.ndarray:
        """(c,) share of the shear strength above the residual that is left; none for elastic groups."""
        left = self.model.state.intact_s
        return np.zeros(0) if left is None else left[span].copy()

    def _stop(self, step: int, g: int, contact: int, compression: float) -> None:
        name, shape, interface = self.model.group_names[g], self.model.groups[0][g], self.model.groups[1][g]
        loss = interface.cohesion - interface.residual_cohesion
        loss += compression * (interface.tan_friction - interface.tan_residual_friction)
        least = loss**2 / (2.0 * interface.shear_stiffness) - compression * (shape.G_II_slope or 0.0)
        raise Stopped(
            f"step {step}: {self.model.contact(contact)} softens under a compression of {compression:.4g} Pa; beyond "
            f"{self.limits[g]:.4g} Pa the curve of law '{type(shape).__name__.lower()}' snaps back and takes more "
            f"energy than contact.{name}.fracture_energy_mode_2. Raise that above {least:.4g} N/m, or choose law "
            "exponential or polynomial, which cannot snap back"
        )
