"""Stress, displacement and rotation of blocks in a state that is known, as frames and files show them.

    stress      affine and tets: a gradient of nine different numbers, sigma = lambda tr(e) + 2 mu e;
                rigid: a block whose six neighbours press it with sigma n, by Love's formula
                order xx yy zz yz xz xy, and xx yy zz xy yz xz in the file for ParaView
    corners     of blocks whose points x move by gradient @ x;   rotation  of the antisymmetric part of the gradient
    closure     of a joint, over the height of the thinner of its two blocks

Reference: Hooke's law, by hand; Love 1927, art. 123.
"""

import numpy as np

from masonry.configuration import energy
from masonry.model.model import Model
from masonry.monitors.frames import Frames
from masonry.monitors.observer import View
from masonry.monitors.openings import Openings
from masonry.monitors.stability import Watch
from masonry.results.vtkhdf import TO_VTK
from verification.case import Case, Findings, Tolerance
from verification.checks.free_motion import glued
from verification.fixtures import models, shapes

COMPONENTS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
NAMES = ("xx", "yy", "zz", "yz", "xz", "xy")
IN_PARAVIEW = ("xx", "yy", "zz", "xy", "yz", "xz")
GRADIENT = 1e-5 * np.array([[3.0, 0.7, -1.1], [0.2, -2.0, 0.5], [1.9, -0.4, 1.3]])
STRESS = 1e6 * np.array([[-0.9, 0.1, 0.25], [0.1, 0.4, -0.15], [0.25, -0.15, 0.7]])
GLUE = glued(2e11, 8e10)
SIZE = np.array([0.2, 0.1, 0.08])
ROUNDING = Tolerance(1e-12, 1e-14, "sums of some products: rounding")


def of_strains(findings: Findings) -> None:
    """Affine blocks and tets in uniform strain."""
    lame, mu = models.STONE.lame()
    strain = 0.5 * (GRADIENT + GRADIENT.T)
    wanted = lame * np.trace(strain) * np.eye(3) + 2.0 * mu * strain
    for kind in ("affine", "tets"):
        blocks = shapes.skewed(
            shapes.stack([0.08, 0.08]), np.array([[1.0, 0.3, 0.0], [0.0, 1.0, 0.2], [0.1, 0.0, 1.0]])
        )
        model = models.make(shapes.setup(blocks, [kind, kind], mesh_size=0.1), GLUE)
        models.put(model, models.positions(model), models.linear_field(model, np.zeros(3), GRADIENT))
        compare(findings, kind, energy.observe(model).stress[1], wanted)
        turned(findings, kind, model, GRADIENT)
        if kind == "affine":
            corners(findings, kind, model, GRADIENT)


def corners(findings: Findings, kind: str, model: Model, gradient: np.ndarray) -> None:
    """Displacement of all corners of blocks whose points x move by gradient @ x."""
    place = model.blocks.points
    off = np.abs(Frames(model).corners() - place @ gradient.T).max()
    quantity = f"{kind}: displacement of the corners, largest deviation"
    findings.check(quantity, "m", off, 0.0, ROUNDING, scale=np.abs(place @ gradient.T).max())


def turned(findings: Findings, kind: str, model: Model, gradient: np.ndarray) -> None:
    """The largest rotation that a run would report: of the antisymmetric part of the gradient."""
    watch = Watch(model, 1.0)
    watch.check(1)
    wanted = float(np.abs(0.5 * (gradient - gradient.T)).max())
    findings.check(f"{kind}: largest rotation", "rad", watch.rotation, wanted, ROUNDING)


def of_contacts(findings: Findings) -> None:
    """A rigid block between six others."""
    low = np.zeros(3)
    sides = [sign * SIZE * axis for axis in np.eye(3) for sign in (-1.0, 1.0)]
    blocks = shapes.boxes([(low + shift, low + shift + SIZE) for shift in (np.zeros(3), *sides)])
    model = models.make(shapes.setup(blocks, ["rigid"] * 7), GLUE)
    joints = model.joints
    model.contacts.force[:] = joints.area[:, None] * (joints.normal @ STRESS)
    compare(findings, "rigid", Frames(model).contact_stress()[0], STRESS)
    rotation = 0.5 * (GRADIENT - GRADIENT.T)
    models.put(model, models.positions(model), models.linear_field(model, np.zeros(3), rotation))
    corners(findings, "rigid", model, rotation)
    turned(findings, "rigid", model, rotation)


def compare(findings: Findings, kind: str, had: np.ndarray, wanted: np.ndarray) -> None:
    """Six components, each relative to the largest."""
    scale = np.abs(wanted).max()
    for k, (name, (i, j)) in enumerate(zip(NAMES, COMPONENTS, strict=True)):
        findings.check(f"{kind}: stress {name}", "Pa", had[k], wanted[i, j], ROUNDING, scale=scale)


def overlapping(findings: Findings) -> None:
    """The closure of a joint is taken over the thinner of its two blocks."""
    model = models.make(shapes.setup(shapes.stack([0.05, 0.1]), ["rigid"] * 2), GLUE)
    seen = energy.Seen(np.full(4, -1e-6), *np.zeros((3, 4)))
    overlap = Openings(model).look(model, View(seen), 0)["overlap"]
    tolerance = Tolerance(1e-12, 1e-15, ROUNDING.reason)
    findings.check("closure of a joint over the thinner block", "1", overlap, 1e-6 / 0.05, tolerance)


def in_order(findings: Findings) -> None:
    """Where the file for ParaView has each component."""
    had = [NAMES[k] for k in TO_VTK]
    tolerance = Tolerance(1e-14, 0.0, "names: exact")
    value = sum(a == b for a, b in zip(had, IN_PARAVIEW, strict=True))
    findings.check("components that stand where ParaView looks for them", "1", value, 6.0, tolerance)


def run() -> Findings:
    """Affine blocks and tets, rigid blocks, and the order of the components."""
    findings = Findings()
    for part in (of_strains, of_contacts, overlapping, in_order):
        part(findings)
    return findings


CASE = Case(
    "stress-of-a-block",
    "A22",
    "Stress, corners and rotation of blocks in a known state",
    area="Elastic assemblies",
    run=run,
    quick=True,
    no_problems="what is read off a state: exact",
)
