"""How near the contacts are to leaving their elastic answer for the first time."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from masonry.configuration.configuration import configuration_of
from masonry.configuration.energy import Seen
from masonry.laws.compression_cap import INITIAL
from masonry.laws.state import JointProperties
from masonry.loading.drive.adaptive_settings import AdaptiveSettings
from masonry.loading.drive.predictor import Predictor
from masonry.model.model import Model
from masonry.runtime.state_file import State, attributes, load_attributes

STEADY, LASTING = 3, 10
"""Rows on end in which a force is borne, so that half a swing is none: where all moves as expected, and where it does
not, as of what slides with the drive nothing is expected: a block that lifts off jerks for about four."""
ROUNDED = 1e-9
"""Share by which a row on a plateau may be above the highest step."""


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


class Dry:
    """Criteria of a drive where contacts are patches (Model.dry): these do not tell how near they are to part or to
    slide, so nothing counts as elastic; and what rocks on them stores next to nothing.

    parting   m, a path in which faces hardly part
    stiffest  N/m, the largest stiffness so far: contacts still swing by it where the specimen has none any more
    rows      of each increment: the drive's force (N, signed), and the share of the kinetic energy that was expected
    """

    def __init__(self, model: Model, settings: AdaptiveSettings, accuracy: float) -> None:
        self.model, self.settings, self.accuracy = model, settings, accuracy
        self.parting, self.stiffest = np.inf, 0.0
        self.rows: list[tuple[float, float]] = []

    def begin(self) -> None:
        """See how far (m) patches are pressed together at most under the dead loads; they part after about as much."""
        pressed, _ = configuration_of(self.model).patches.deepest(np.ones(self.model.blocks.count))
        if pressed > 0.0:
            self.parting = self.settings.parting * pressed

    def shortest(self, moved: float) -> float:
        """The least increment (m) after a path (m); the first one makes as much."""
        return min(self.accuracy / self.settings.parts, 1.0) * max(self.parting, self.settings.shortest * moved)

    def factor(self, rise: float, unit: float) -> float:
        """Of the speed, after an increment whose force rose or fell by a share `rise` of the largest; what lifts off at
        such a speed hardly overshoots."""
        settings = self.settings
        rises = min(settings.rises * unit, settings.lifts * self.accuracy)
        return float(np.clip(rises / max(rise, 1e-12), settings.slower, settings.faster))

    def see(self, force: float, trust: float) -> None:
        """The force (N) of the drive, after an increment of whose kinetic energy such a share was expected."""
        self.rows.append((force, trust))

    def excess(self, peak: float) -> float:
        """Share of the largest force (N) at any step of the drive by which it is more than what was borne steadily, in
        rows on end: damping and inertia of what lifts off took the rest. What was borne beyond it came in a fall."""
        if peak == 0.0 or len(self.rows) < STEADY:
            return float(peak != 0.0)
        force, trust = np.array(self.rows).T
        along, least = sliding_window_view([force / peak, trust], STEADY, axis=1).min(axis=2)
        borne = along[least >= self.settings.steady]
        if len(force) >= LASTING:
            borne = np.append(borne, sliding_window_view(force / peak, LASTING).min(axis=1))
        return max(float(1.0 - borne[borne <= 1.0 + ROUNDED].max(initial=0.0)), 0.0)

    def stiffness(self, reach: float, force: float) -> float | None:
        """N/m, after the drive's force (N) at the farthest place (m) so far; None where nothing has parted."""
        if reach > self.parting:
            self.stiffest = max(self.stiffest, force / reach)
        return self.stiffest or None

    def damping(self, damped: float, guide: Predictor) -> float:
        """J that damping took so far, of J in the ledger; of dry contacts less what it lent to the expected motion,
        which it gets back."""
        return damped + (guide.kinetic if self.model.dry else 0.0)

    def state(self) -> State:
        """All but what it is made of."""
        return {**attributes(self, ("parting", "stiffest")), "rows": np.array(self.rows).reshape(-1, 2)}

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, ("parting", "stiffest"), state)
        self.rows = [(force, trust) for force, trust in state["rows"].tolist()]
