"""Whether contacts took more energy of mode II than their law has: the area under its curve, above the residual."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.laws.law_dispatch import beside, shear_intact
from masonry.laws.snap_back import lost_in_shear
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View

LOOKED_AT = 5
"""Contacts of a group that are looked at, those that took most."""
GONE, NEAREST, FARTHEST = 1e-2, 1e-15, 1e3
"""Share left by which the length of a curve is taken; slips (m) between which it is looked for."""
BEFORE, BEYOND, POINTS = 1e-4, 1e5, 400
"""From where to where a curve is integrated, over that length, and by how many points."""


@dataclass(frozen=True)
class TakenInShear:
    """Over the area of the law: the largest energy of mode II of a contact; and the largest compression (C,) Pa."""

    over_law: float
    compression: np.ndarray


class LawArea(Observer):
    """The largest compression of each contact at the rows so far: between it and none lies the area of the law."""

    REMEMBERED = ("compression",)

    def __init__(self, model: Model) -> None:
        self.model = model
        self.compression = np.zeros(len(model.group))

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        np.maximum(self.compression, -view.seen.sigma, out=self.compression)
        return {}

    def records(self) -> list[Any]:
        return [TakenInShear(self.most_taken(), self.compression)]

    def most_taken(self) -> float:
        """Largest energy of mode II of a contact over the area of its law, without compression or at the largest.

        A torn contact with residual cohesion is left out: it loses that too, and finds it again on closing.
        """
        law_parameters, joint_properties, _, bounds = self.model.groups
        most = 0.0
        for g, (parameters, joint) in enumerate(zip(law_parameters, joint_properties, strict=True)):
            if joint.tensile_strength is None or beside(type(parameters), "shear_intact") is None:
                continue
            dissipated = self.model.state.dissipated[bounds[g] : bounds[g + 1], 1]
            lost = lost_in_shear(joint, self.compression[bounds[g] : bounds[g + 1]])
            fraction = np.divide(dissipated, lost, out=np.zeros_like(dissipated), where=lost > 0.0)
            fraction[(joint.residual_cohesion > 0.0) & (self.model.state.intact_n[bounds[g] : bounds[g + 1]] < 1.0)] = (
                0.0
            )
            for c in np.argsort(fraction)[-LOOKED_AT:]:
                if fraction[c] > 0.0:
                    between = 0.0, float(self.compression[bounds[g] + c])
                    has = max(area(_of(parameters, c), _of(joint, c), compression) for compression in between)
                    most = max(most, float(dissipated[c]) / has) if has > 0.0 else most
        return most


def area(parameters, joint, compression: float) -> float:
    """Area (J/m2) under a law's curve in shear at a compression (Pa), above the residual.

    Over the total slip it includes the elastic part, over plastic slip it does not. What is lost at once lets go of the
    elastic part by either.
    """
    drop = float(lost_in_shear(joint, compression))
    if drop <= 0.0:
        return 0.0
    residual = joint.residual_cohesion + compression * joint.tan_residual_friction

    def left(slip: float) -> float:
        return float(shear_intact(parameters, joint, 1.0, slip, residual + drop, residual, compression))

    low, high = NEAREST, FARTHEST
    for _ in range(100):
        middle = (low * high) ** 0.5
        low, high = (low, middle) if left(middle) <= GONE else (middle, high)
    slip = np.concatenate([[0.0], np.geomspace(BEFORE * high, BEYOND * high, POINTS)])
    beyond = drop * float(np.trapezoid([1.0, *map(left, slip[1:])], slip))
    triangle = 0.5 * drop * drop / joint.shear_stiffness
    return max(beyond, triangle) if joint.plastic_softening is not None else beyond + triangle


def _of(fields, contact: int):
    """The NamedTuple of one contact, where some fields are arrays over the contacts of a group."""
    return type(fields)(*(value[contact] if np.ndim(value) else value for value in fields))
