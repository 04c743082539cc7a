"""A contact of unit area and normal z, taken along a path of relative displacements by the compiled sweep itself.

There are nine of it: the sweep takes eight at once, then the ninth with seven empty places.
"""

from typing import NamedTuple

import numpy as np

from masonry.arrays import in_rows
from masonry.kernels.compiler import jit
from masonry.kernels.contact import observe, sweep
from masonry.kernels.lanes.room import aligned
from masonry.laws.build import build
from masonry.laws.state import ContactState, fresh

COUNT = 9
SIDES = aligned(np.tile(np.array([0, 1], dtype=np.uint32), (COUNT, 1)))
NORMAL, AREA = aligned(np.tile([0.0, 0.0, 1.0], (COUNT, 1))), aligned(np.ones(COUNT))

TABLE_1 = {
    "normal_stiffness": 150e9,
    "shear_stiffness": 70e9,
    "tensile_strength": 0.58e6,
    "cohesion": 0.87e6,
    "tan_friction": 1.01,
    "residual_cohesion": 0.0,
    "tan_residual_friction": 0.73,
    "fracture_energy_mode_1": 5.8,
    "fracture_energy_mode_2": 58.0,
    "fracture_energy_mode_2_slope": 130e-6,
    "exponent_tension": 3.0,
    "exponent_shear": 2.5,
}
"""SI; fT, G_I and the exponents are those of the packaged scene `couplet`."""


class Walk(NamedTuple):
    """What a contact did along a path of N points: stress (N, 3) Pa, spent (N, 3) and stored (N,) J/m2, history."""

    path: np.ndarray
    stress: np.ndarray
    spent: np.ndarray
    stored: np.ndarray
    opening_max: np.ndarray
    intact_n: np.ndarray
    intact_s: np.ndarray
    slip: np.ndarray

    @property
    def sigma(self) -> np.ndarray:
        return self.stress[:, 2]

    @property
    def tau(self) -> np.ndarray:
        return np.hypot(self.stress[:, 0], self.stress[:, 1])

    @property
    def dissipated(self) -> np.ndarray:
        return self.spent.sum(axis=1)

    @property
    def work(self) -> np.ndarray:
        """Trapezoid of the whole stress over the path, which starts at rest at the origin."""
        path = np.vstack([np.zeros(3), self.path])
        stress = np.vstack([np.zeros(3), self.stress])
        return np.cumsum(0.5 * np.sum((stress[1:] + stress[:-1]) * np.diff(path, axis=0), axis=1))

    @property
    def gap(self) -> np.ndarray:
        """Work less what is stored less what is booked as spent: 0 but for the size of the steps."""
        return self.work - self.stored - self.dissipated


def law(name: str, **changes) -> tuple:
    """(shape, interface) of Table 1 with some properties changed, by the same door as a scene."""
    return build("unit_unit", {"law": name, **TABLE_1, **changes})


def contact(interface) -> ContactState:
    """A contact, nine times, that nothing has happened to; only the memory that its options need."""
    if interface.tensile_strength is None:
        return ContactState()
    return fresh(
        np.full(COUNT, interface.tensile_strength / interface.normal_stiffness),
        np.full(COUNT, interface.normal_stiffness),
        dilates=interface.tan_dilation is not None,
        gap=interface.elastic_unloading is not None,
    )


def walk(law: tuple, path: np.ndarray, state: ContactState | None = None, ninth: bool = False) -> Walk:
    """Take a fresh contact (or one with a history) along path (N, 3) m: slip x, slip y, opening.

    What comes back is the first contact's way, or the ninth's.
    """
    shape, interface = law
    state = contact(interface) if state is None else state
    path = np.ascontiguousarray(path, dtype=float)
    seen = np.zeros((len(path), 2, 13))
    u, force, view = in_rows(np.zeros((2, 3))), in_rows(np.zeros((COUNT, 3))), np.zeros((COUNT, 4))
    if state.spent is None:
        _springs(shape, interface, state, path, u, force, view, seen)
    else:
        _march(shape, interface, state, SIDES, NORMAL, AREA, path, u, force, view, seen)
    one = seen[:, 1 if ninth else 0]
    opening_max, intact_n, intact_s = one[:, 7:10].T
    return Walk(path, one[:, :3], one[:, 3:6], one[:, 6], opening_max, intact_n, intact_s, one[:, 10:])


@jit
def _march(shape, interface, state, sides, normal, area, path, u, force, view, seen):
    first, last = np.uint32(0), np.uint32(len(area))  # as in a model, so that what it compiled serves here too
    for k in range(len(path)):
        for i in range(3):
            u[1, i] = path[k, i]
        sweep(None, shape, interface, state, first, last, sides, normal, area, u, force)
        stored = observe(shape, interface, state, first, last, sides, normal, area, u, force, view) / len(area)
        for which, c in enumerate((0, len(area) - 1)):
            seen[k, which, 6] = stored
            for i in range(3):
                seen[k, which, i] = force[c, i]
                seen[k, which, 3 + i] = state.spent[c, i]
                seen[k, which, 10 + i] = state.slip[c, i]
            seen[k, which, 7] = state.opening_max[c]
            seen[k, which, 8] = state.intact_n[c]
            seen[k, which, 9] = state.intact_s[c]


def _springs(shape, interface, state, path, u, force, view, seen):
    """The same without a history, for the elastic law."""
    for k, relative in enumerate(path):
        u[1] = relative
        sweep(None, shape, interface, state, 0, COUNT, SIDES, NORMAL, AREA, u, force)
        seen[k, :, :3] = force[[0, -1]]
        stored = observe(shape, interface, state, 0, COUNT, SIDES, NORMAL, AREA, u, force, view)
        seen[k, :, 6] = stored / COUNT


def along(corners, most: float = 0.1e-6) -> np.ndarray:
    """(N, 3) m: the straight path through the corners, in steps no longer than `most`, every corner hit exactly."""
    corners = np.atleast_2d(np.asarray(corners, dtype=float))
    legs = [corners[:1]]
    for begin, end in zip(corners[:-1], corners[1:], strict=True):
        count = max(1, int(np.ceil(np.linalg.norm(end - begin) / most)))
        share = (np.arange(1, count + 1) / count)[:, None]
        leg = begin + share * (end - begin)
        leg[-1] = end
        legs.append(leg)
    return np.concatenate(legs)
