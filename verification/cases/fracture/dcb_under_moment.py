"""A double cantilever beam opened by moments at its ends: the moment at which the crack runs, whatever the law.

              M ( |=============================================
    a0            |             arm, height h, width B          |
    crack ------- ==============joint===========================    G = energy of the joint per area
                  |             arm                             |
              M ( |=============================================

J-integral along the outline: J = 12 M^2/(B^2 E h^3), the same at every crack length, and equal to the whole area under
the joint's curve once its process zone is complete. So, for any law, stiffness and crack length,

    M = B sqrt(G E h^3/12)

By symmetry one arm is computed, on a joint of twice the stiffness and half the energy per area over a rigid base, with
no stiffness in shear to speak of. nu = 0: plane stress and plane strain are one. Moments are controlled by the ends'
turn in the run (a rigid plate, glued on), by the opening of the process zone in the interface model, whose moment comes
from a linear traction.

Linear tets are too stiff in bending, and M grows by the root of that. With elements half as long as tall the excess is
7.2 % at 4 layers and 1.9 % at 8, as another finite element program gave it; it falls as h^2. Reference: Rice (1968) for
J of the pure bending specimen; Sorensen and Jacobsen (2003) for its use with cohesive laws.
"""

import numpy as np
from skfem import MeshTet

from geometry.blocks import Specimen, TetMesh
from geometry.polyhedra.construct import from_boxes
from masonry.laboratory import laboratory
from masonry.loading.programs import program
from masonry.timeloop import timeloop
from verification.case import Case, Findings, Line, Tolerance
from verification.checks.other_conditions import turned
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import grids
from verification.references.interface.model import InterfaceModel, model
from verification.references.interface.newton import EquilibriumPath
from verification.scene_runs import assembled

Array = np.ndarray
Curve = tuple[Array, Array]
YOUNG, ENERGY, STRENGTH, KN = 10e9, 10.0, 1e6, 1e12
HEIGHT, WIDTH, LENGTH, CRACK, NEAR = 0.012, 0.003, 0.072, 0.012, 1e-9
SECOND_MOMENT = WIDTH * HEIGHT**3 / 12
MOMENT = WIDTH * float(np.sqrt(ENERGY * YOUNG * HEIGHT**3 / 12))
ROTATION = MOMENT / (YOUNG * SECOND_MOMENT)
"""rad of an arm's end for each metre of its length, at MOMENT."""
PLATEAU = (0.033 * ROTATION, 0.048 * ROTATION)
"""Turns (rad) between which the process zone is complete and does not feel the far end."""
OPENING = 1e-6
LAYERS = (4, 8)
STEPS = 150_000
SCENE = "dcb-under-moment"


def lines(layers: int, degree: int = 1) -> tuple[Array, Array, Array]:
    """Grid lines (m): elements are half as long as tall; quadratic ones as long as tall."""
    cells = round((2 if degree == 1 else 1) * LENGTH / HEIGHT * layers)
    return np.linspace(0.0, LENGTH, cells + 1), np.array([0.0, WIDTH]), np.linspace(0.0, HEIGHT, layers + 1)


def arm(layers: int, degree: int) -> InterfaceModel:
    """The interface model, loaded by a linear traction of the moment 1 N m at x = 0."""
    x, y, z = lines(layers, degree)
    body = grids([(x[x > CRACK - NEAR], y, np.array([-0.003, 0.0])), (x, y, z)])
    law = Law("linear", 2 * KN, 1.0, fT=STRENGTH, c0=STRENGTH, G_I=0.5 * ENERGY, G_II=1e13)
    assembled = model(body, YOUNG, 0.0, lambda a, b: law, degree)
    assembled.hold("xyz", lambda place, block: block == 0)
    assembled.hold("y", lambda place, block: block == 1)
    far = LENGTH - NEAR, 0.5 * HEIGHT
    assembled.hold("x", lambda p, b: (b == 1) & (p[:, 0] > far[0]) & (np.abs(p[:, 2] - far[1]) < NEAR))
    assembled.load = assembled.traction(
        lambda p: np.stack([(p[2] - far[1]) / SECOND_MOMENT, 0.0 * p[0], 0.0 * p[0]]), lambda p: p[0] < NEAR
    )
    return assembled


def implicit(layers: int, degree: int) -> Curve:
    """Turn of the end (rad) and moment (N m) of the interface model, as far as the plateau goes."""
    beam = arm(layers, degree)
    path, rotation, moment = EquilibriumPath(beam), [0.0], [0.0]
    path.go(0.1 * MOMENT)
    while rotation[-1] < 1.02 * PLATEAU[1] and len(rotation) < 200:
        path.open_by(OPENING)
        rotation.append(float(beam.load @ path.displacements()))
        moment.append(path.state.factor)
    return np.array(rotation), np.array(moment)


def explicit(findings: Findings, layers: int) -> Curve:
    """The same of a run on the same tets."""
    part = MeshTet.init_tensor(*lines(layers))
    nodes, tets = part.p.T.copy(), part.t.T.astype(np.int64)
    turned_over = np.linalg.det(nodes[tets[:, 1:]] - nodes[tets[:, :1]]) < 0
    tets[turned_over] = tets[turned_over][:, [1, 0, 2, 3]]
    low = np.array([[0.0, 0.0, 0.0], [CRACK, 0.0, -0.003], [-0.003, 0.0, 0.0]])
    high = np.array([[LENGTH, WIDTH, HEIGHT], [LENGTH, WIDTH, 0.0], [0.0, WIDTH, HEIGHT]])
    blocks = from_boxes(low, high, np.arange(3), np.arange(3), ("units", "base", "plates"))
    mesh = TetMesh(nodes, np.array([0, *[len(nodes)] * 3]), tets, np.array([0, *[len(tets)] * 3]))
    sets = {name: np.array([k]) for k, name in enumerate(("arm", "base", "plate"))}
    assembly = turned(assembled(SCENE, None, Specimen(blocks, sets, 1.0), mesh), "y")
    plan = program(assembly.model.dt, 0, 1.04 * PLATEAU[1], STEPS, None, 0.2)
    outcome = timeloop.run(assembly.model, plan, assembly.recording)
    rows = findings.note(f"{layers} layers", laboratory.result_of(assembly, outcome)).history.rows
    return rows["displacement"], rows["stress"]


def plateau(curve: Curve) -> float:
    """Mean moment (N m) over the plateau."""
    rotation, moment = curve
    where = np.linspace(*PLATEAU, 2001)
    return float(np.mean(np.interp(where, rotation, moment)))


def run() -> Findings:
    """Plateaus of tier 2, of tier 1 and of runs at two sizes of elements."""
    findings = Findings()
    fine = implicit(8, 2)
    curves = {f"interface model, quadratic tets, {8} layers": fine}
    tolerance = Tolerance(
        5e-4,
        1e-4,
        "a process zone of 13 elements: the moment swings by 3e-4 as the crack passes them, its mean by less",
    )
    findings.check("plateau of quadratic tets, 8 layers", "N m", plateau(fine), MOMENT, tolerance)
    excess = []
    for layers, band in zip(LAYERS, (0.072, 0.019), strict=True):
        same, ran = implicit(layers, 1), explicit(findings, layers)
        curves |= {f"interface model, {layers} layers": same, f"run, {layers} layers": ran}
        excess.append(plateau(ran) / MOMENT - 1.0)
        tolerance = Tolerance(
            5e-3,
            1e-3,
            "the drive is steady and slow: inertia and a little damping add what falls as its speed",
            "same discretisation",
        )
        quantity = f"plateau of a run against linear tets of the interface model, {layers} layers"
        findings.check(quantity, "N m", plateau(ran), plateau(same), tolerance)
        tolerance = Tolerance(2e-3, 1e-3, "that program gave the moment to three digits", "refined model")
        quantity = f"excess of linear tets over the closed form, interface model, {layers} layers"
        findings.check(quantity, "1", plateau(same) / MOMENT - 1.0, band, tolerance, scale=1.0)
    tolerance = Tolerance(0.1, 0.03, "h^2, with what the speed of the drive adds, which does not fall with h")
    value = np.log2(excess[0] / excess[1])
    findings.check("order of the run's excess over the closed form", "1", value, 2.0, tolerance)
    findings.plot("Moment against the turn of the arm's end", "turn (mrad)", "moment (N m)",
               *(Line(k, t * 1e3, m, "line" if "run" in k else "dashed") for k, (t, m) in curves.items()))  # fmt: skip
    return findings


CASE = Case(
    "dcb-under-moment",
    "A9",
    "Double cantilever beam opened by moments: the plateau",
    area="Fracture",
    run=run,
    scene=SCENE,
    problems=("dcb-force",),
)
