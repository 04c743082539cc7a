"""How near the contacts are to leaving their elastic answer for the first time."""

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.configuration.energy import Seen
from masonry.laws.compression_cap import INITIAL
from masonry.laws.state import JointProperties
from masonry.loading.drive.adaptive_settings import AdaptiveSettings
from masonry.loading.drive.predictor import Predictor
from masonry.model.model import Model
from masonry.runtime.state_file import Remembering


def utilisation(model: Model, seen: Seen, rest: np.ndarray) -> float:
    """Largest share of its strength that a contact uses, in tension, shear or compression; at 1 it tears, slips, opens
    or begins to crush.

    rest  (C,) Pa, normal stress under the dead loads alone: a joint without tensile strength opens when that has gone
    """
    _, joint_properties, _, bounds = model.groups
    most = 0.0
    for g, joint in enumerate(joint_properties):
        if joint.tensile_strength is None:
            continue
        span = slice(bounds[g], bounds[g + 1])
        sigma, tau = seen.sigma[span], seen.tau[span]
        strength = joint.cohesion - sigma * joint.tan_friction
        in_shear = np.where(tau > 0.0, np.divide(tau, strength, out=np.ones_like(tau), where=strength > 0.0), 0.0)
        capacity = joint.tensile_strength - np.minimum(rest[span], 0.0)
        gained = sigma - np.minimum(rest[span], 0.0)
        in_tension = np.divide(gained, capacity, out=np.ones_like(sigma), where=capacity > 0.0)
        shares = in_shear, in_tension, pressed_over_cap(joint, sigma, tau)
        most = max(most, *(float(share.max(initial=0.0)) for share in shares))
    return min(most, 1.0)


def pressed_over_cap(joint: JointProperties, sigma: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """(n,) compression over that at which a contact begins to crush, shear included; none where it cannot."""
    if joint.compressive_strength is None:
        return np.zeros(0)
    begins = joint.compressive_strength * (1.0 if joint.cap_shear_factor is None else INITIAL)
    pressed = np.minimum(sigma, 0.0) ** 2 + (joint.cap_shear_factor or 0.0) * tau**2
    return np.asarray(np.sqrt(pressed) / begins)


class Dry(Remembering):
    """What a drive goes by where contacts are patches (Model.dry): these do not tell how near they are to part or to
    slide, so nothing counts as elastic; and what rocks on them stores next to nothing.

    parting   m, the shortest path in which faces may part, which the first increment makes
    stiffest  N/m, the largest stiffness so far: contacts still swing by it where the specimen has none any more
    """

    REMEMBERED = ("parting", "stiffest")

    def __init__(self, model: Model, settings: AdaptiveSettings) -> None:
        self.model, self.settings = model, settings
        self.parting, self.stiffest = np.inf, 0.0

    def begin(self) -> None:
        """See how far (m) patches are pressed together at most under the dead loads; they part after about as much."""
        pressed, _ = configuration_of(self.model).deepest(np.ones(self.model.blocks.count))
        if pressed > 0.0:
            self.parting = self.settings.parting * pressed

    def shortest(self, moved: float) -> float:
        """The least increment (m) after a path (m)."""
        return max(self.parting, self.settings.shortest * moved)

    def factor(self, rise: float, unit: float) -> float:
        """Of the speed, after an increment whose force rose or fell by a share `rise` of the largest; what lifts off at
        such a speed hardly overshoots."""
        return float(np.clip(self.settings.rises * unit / max(rise, 1e-12), self.settings.slower, self.settings.faster))

    def stiffness(self, reach: float, force: float) -> float | None:
        """N/m, after the drive's force (N) at the farthest place (m) so far; None where nothing has parted."""
        if reach > self.parting:
            self.stiffest = max(self.stiffest, force / reach)
        return self.stiffest or None

    def damping(self, damped: float, guide: Predictor) -> float:
        """J that damping took so far, of J in the ledger; of dry contacts less what it lent to the expected motion,
        which it gets back."""
        return damped + (guide.kinetic if self.model.dry else 0.0)
