"""Which contacts press under the dead loads: the elastic equilibrium of joints that do not pull more than they can."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from masonry.errors import SceneError
from masonry.modal_analysis.eigen import SHIFT, factorised
from masonry.modal_analysis.oscillator import PER_CONTACT, Oscillator

ROUNDS = 60
"""Of opening what pulls and closing what overlaps, at most."""
FAR = 0.1
"""Share of the size of the specimen: what moves by more has nothing to rest on."""
NEARLY = 1e-9
"""Share of the largest pressure that is no tension."""


@dataclass(frozen=True)
class Pressed:
    """closed (C,) which contacts are closed; slides (C,) which bear more shear than friction and cohesion hold."""

    closed: np.ndarray
    slides: np.ndarray


def pressed(oscillator: Oscillator) -> Pressed:
    """The contacts that are closed once the dead loads have settled, without friction's limit on the shear they bear.

    Contacts open where they would pull by more than their tensile strength, and close where their sides would overlap.
    Raises SceneError where no dead load presses, or where what is left does not stand.
    """
    if not oscillator.load[oscillator.free].any():
        raise SceneError("nothing presses the joints: the scene has no gravity and no other dead load")
    strength, friction, cohesion = (_strengths(oscillator, which) for which in range(3))
    area = oscillator.joints.area
    closed, torn = np.ones(len(area), dtype=bool), np.zeros(len(area), dtype=bool)
    for _ in range(ROUNDS):
        jump = equilibrium(oscillator, closed)
        pull = oscillator.normal * jump[:, 0]
        least = NEARLY * float(np.abs(pull).max(initial=0.0))
        torn |= closed & (pull > strength * area + least)
        limit = np.where(torn, 0.0, strength * area)
        after = np.where(closed, pull <= limit + least, jump[:, 0] < 0.0)
        if np.array_equal(after, closed):
            break
        closed = after
    else:
        raise SceneError(
            f"which joints press is not settled in {ROUNDS} rounds: run the scene, whose settling decides, or leave "
            "out --pressed"
        )
    shear = oscillator.shear * np.linalg.norm(jump[:, 1:], axis=1)
    holds = np.isinf(friction)
    borne = cohesion * area - np.where(holds, 0.0, friction) * np.minimum(pull, 0.0)
    return Pressed(closed, closed & ~holds & (shear > borne + least))


def equilibrium(oscillator: Oscillator, closed: np.ndarray) -> np.ndarray:
    """(C, 3) m, jumps along the normal and across it of all contacts, where those that are closed bear the loads."""
    dofs = np.flatnonzero(oscillator.free)
    strain_matrix = sparse.csc_array(oscillator.closed(closed)[:, dofs])
    matrix = sparse.csc_array(strain_matrix.T @ strain_matrix)
    root = np.sqrt(np.maximum(matrix.diagonal(), 1e-12 * matrix.diagonal().max(initial=1e-300)))
    even = sparse.diags_array(1.0 / root)
    u = np.zeros(len(oscillator.mass))
    u[dofs] = factorised(sparse.csc_array(even @ matrix @ even), SHIFT)(oscillator.load[dofs] / root) / root
    size = float(np.ptp(oscillator.specimen.blocks.points, axis=0).max())
    rows = oscillator.by_kind(u)
    if max(float(np.abs(values[:, :3]).max(initial=0.0)) for values in rows.values()) > FAR * size:
        raise SceneError(
            "it does not stand on joints that press: under the dead loads something has nothing to rest on; leave out "
            "--pressed, or run the scene"
        )
    count = len(closed)
    scaled = (oscillator.strain_matrix @ u)[: PER_CONTACT * count].reshape(count, PER_CONTACT)
    return np.asarray(scaled / np.sqrt(np.column_stack([oscillator.normal, oscillator.shear, oscillator.shear])))


def _strengths(oscillator: Oscillator, which: int) -> np.ndarray:
    """(C,) of each contact: tensile strength (Pa), tangent of the friction angle, or cohesion (Pa)."""
    rows = [
        (np.inf, np.inf, np.inf)
        if joint.tensile_strength is None
        else (joint.tensile_strength, joint.tan_friction or 0.0, joint.cohesion or 0.0)
        for joint in oscillator.properties
    ]
    return np.array(rows, dtype=float).reshape(-1, 3)[oscillator.group, which]
