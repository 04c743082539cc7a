"""Where a law's curve snaps back under the compression that a run brings: looked at between chunks."""

import numpy as np

from geometry.jit_cache import compiled
from masonry.errors import Stopped
from masonry.laws.law_dispatch import word_of
from masonry.laws.snap_back import given_mode_2_energy, least_mode_2_energy
from masonry.model.model import Model
from masonry.runtime.state_file import State


class SnapBack:
    """Stops a run in which a contact softens in shear under more compression than its law's energy is enough for.

    Beyond that compression the strength would drop at once and take more energy than the fracture energy given. The
    compression is looked at before and after the steps of a chunk in which a contact softens; the slope of the curve is
    that at the share of the strength which was left before.
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        law_parameters, joint_properties, _, bounds = model.groups
        spans = [slice(int(a), int(b)) for a, b in zip(bounds[:-1], bounds[1:], strict=True)]
        self.spans = [
            (g, span)
            for g, span in enumerate(spans)
            if least_mode_2_energy(law_parameters[g], joint_properties[g], 0.0) is not None
        ]
        self.before = {g: self._now(span, np.full(span.stop - span.start, np.inf))[:2] for g, span in self.spans}

    def check(self, step: int) -> None:
        """Raise Stopped, naming the contact, if one has softened with too little energy since the last look."""
        law_parameters, joint_properties = self.model.groups[:2]
        for g, span in self.spans:
            earlier, left = self.before[g]
            compression, intact, softens = self._now(span, left)
            self.before[g] = compression, intact
            if not softens:
                continue
            most = np.maximum(compression, earlier)
            lacking = least_mode_2_energy(law_parameters[g], joint_properties[g], most, left) - given_mode_2_energy(
                law_parameters[g], most
            )
            lacking[~(intact < left)] = -np.inf
            worst = int(np.argmax(lacking))
            if lacking[worst] > 0.0:
                self._stop(step, g, span.start + worst, float(most[worst]), float(lacking[worst]))

    def state(self) -> State:
        """By number of the group: compression and share left at the last look."""
        return {str(g): list(before) for g, before in self.before.items()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        self.before = {g: (state[str(g)][0], state[str(g)][1]) for g, _ in self.spans}

    def _now(self, span: slice, left: np.ndarray) -> tuple[np.ndarray, np.ndarray, bool]:
        """Of a group's contacts: compression (c,) Pa, from the force that acts, 0 in tension; share (c,) of the shear
        strength above the residual that is left; and whether one has less than `left` (c,)."""
        _, normal, _, _, force = self.model.contacts
        area = self.model.joints.area[span]  # not that of the contacts, which is 0 where a bond has retired
        now = np.empty((2, len(area)))
        softens = compress(force[span], normal[span], area, self.model.state.intact_s[span], left, *now)
        return now[0], now[1], softens

    def _stop(self, step: int, g: int, contact: int, compression: float, lacking: float) -> None:
        parameters, bounds = self.model.groups.parameters[g], self.model.groups.bounds
        if np.ndim(parameters.G_II) == 0:
            wanted = f"above {parameters.G_II + lacking:.4g} N/m"
        else:
            drawn = parameters.G_II[contact - bounds[g]]
            wanted = f"by more than {1.0 + lacking / drawn:.4g} times (drawn here: {drawn:.4g} N/m)"
        raise Stopped(
            f"step {step}: {self.model.contact(contact)} softens under a compression of {compression:.4g} Pa, where "
            f"the curve of law '{word_of(parameters)}' snaps back and takes more energy than given: raise "
            f"contact.{self.model.group_names[g]}.fracture_energy_mode_2 {wanted}, or "
            'choose law exponential with softening_variable = "displacement", which cannot snap back'
        )


@compiled
def compress(force, normal, area, intact, left, compression, kept):
    """Write the compression (c,) of forces (c, 3) on areas (c,), and a copy (c,) of what is intact; returns whether one
    has less than `left` (c,)."""
    softens = False
    for c in range(len(area)):
        along = force[c, 0] * normal[c, 0] + force[c, 2] * normal[c, 2] + force[c, 1] * normal[c, 1]
        compression[c] = max(-along / area[c], 0.0)
        kept[c] = intact[c]
        softens = softens or intact[c] < left[c]
    return softens
