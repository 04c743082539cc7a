"""One contact of unit area and normal z, taken along a path of relative displacements by the compiled sweep itself."""

from typing import NamedTuple

import numpy as np

from masonry.kernels.compiler import jit
from masonry.kernels.contact import observe, sweep
from masonry.laws.build import build
from masonry.laws.state import ContactState, fresh

SIDES, NORMAL, AREA = np.array([[0, 1]]), np.array([[0.0, 0.0, 1.0]]), np.ones(1)

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
    """One contact that nothing has happened to; only the memory that its options need."""
    if interface.tensile_strength is None:
        return ContactState()
    dilates = interface.tan_dilation is not None
    return fresh(
        1,
        np.array([interface.tensile_strength / interface.normal_stiffness]),
        uplift=dilates,
        gap=interface.elastic_unloading is not None,
        run=dilates or interface.plastic_softening is not None,
    )


def walk(law: tuple, path: np.ndarray, state: ContactState | None = None) -> Walk:
    """Take a fresh contact (or one with a history) along path (N, 3) m: slip x, slip y, opening."""
    shape, interface = law
    state = contact(interface) if state is None else state
    path = np.ascontiguousarray(path, dtype=float)
    seen = np.zeros((len(path), 13))
    if state.spent is None:
        _springs(shape, interface, state, path, seen)
    else:
        _march(shape, interface, state, SIDES, NORMAL, AREA, path, seen)
    return Walk(path, seen[:, :3], seen[:, 3:6], seen[:, 6], *seen[:, 7:10].T, seen[:, 10:])


@jit
def _march(shape, interface, state, sides, normal, area, path, seen):
    u, force, view = np.zeros((2, 3)), np.zeros((1, 3)), np.zeros((1, 4))
    for k in range(len(path)):
        for i in range(3):
            u[1, i] = path[k, i]
        sweep(None, shape, interface, state, 0, 1, sides, normal, area, u, force)
        seen[k, 6] = observe(shape, interface, state, 0, 1, sides, normal, area, u, force, view)
        for i in range(3):
            seen[k, i] = force[0, i]
            seen[k, 3 + i] = state.spent[0, i]
            seen[k, 10 + i] = state.slip[0, i]
        seen[k, 7] = state.opening_max[0]
        seen[k, 8] = state.intact_n[0]
        seen[k, 9] = state.intact_s[0]


def _springs(shape, interface, state, path, seen):
    """The same without a history, for the elastic law."""
    u, force, view = np.zeros((2, 3)), np.zeros((1, 3)), np.zeros((1, 4))
    for k, relative in enumerate(path):
        u[1] = relative
        sweep(None, shape, interface, state, 0, 1, SIDES, NORMAL, AREA, u, force)
        seen[k, :3] = force[0]
        seen[k, 6] = observe(shape, interface, state, 0, 1, SIDES, NORMAL, AREA, u, force, view)


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
