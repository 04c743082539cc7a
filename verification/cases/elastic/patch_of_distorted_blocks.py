"""A patch of three distorted blocks under any uniform stress: both models are exact.

        __________________________
       |        /         \\        |          joints at a slant, x = x_k + a_k y + b_k z, and tets of any shape
       |       /           \\       |
       |______/_____________\\______|

All six faces of the patch bear sigma n. Then every block has the displacement gradient that belongs to sigma, and every
joint a constant jump, kn sigma_nn across and ks along:

    u = H x + (sum of the jumps of the joints before x)      jump = n sn/kn + (sigma n - n sn)/ks,   sn = n.sigma n

It must be found to rounding, as a third of a facet's area at each of its corners integrates the linear shape functions
exactly. Three nodes are held in six dofs, the run comes to rest by damping; what is left is compared without the
rigid motion of the whole patch. In the interface model the outline moves as it must, and the inside is found; points at
the corners of quadratic facets, whose weights there should be zero, must fail.
"""

import numpy as np
from skfem import MeshTet

from geometry.blocks import Specimen, TetMesh
from geometry.polyhedra.construct import from_faces
from masonry.laboratory import laboratory
from masonry.model.layout import Layout
from masonry.model.loads import Conditions
from masonry.timeloop import timeloop
from verification.case import Case, Findings, Tolerance
from verification.checks.other_conditions import rebuilt
from verification.fixtures.scene_text import assembled, made_of_tets
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import solid
from verification.references.interface.model import model
from verification.references.interface.newton import EquilibriumPath

Array = np.ndarray
YOUNG, POISSON, KN, KS = 5e9, 0.2, 2e11, 8e10
SIZE = np.array([0.3, 0.1, 0.12])
PLANES = ((0.0, 0.0, 0.0), (0.1, 0.25, -0.2), (0.2, -0.3, 0.15), (0.3, 0.0, 0.0))
"""x_k, a_k, b_k of the ends and the joints."""
STRESS = np.array([[0.8, 0.3, -0.2], [0.3, -0.5, 0.25], [-0.2, 0.25, 0.4]]) * 1e6
CELLS, NEAR = 3, 1e-9
FACES = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
SCENE = f"""title = "Patch of distorted blocks"
{made_of_tets(1900.0, YOUNG, POISSON, KN, KS)}[[support]]
on = "x = 0 m"
fix = "all"
[settle]
steps = 20000
[solver]
rows = 20
""" + "".join(
    f'[[traction]]\non = "{"xyz"[k]} = {level!r} m"\n'
    + "stress = {"
    + ", ".join(f'{axis} = "{sign * float(STRESS[k, i])!r} Pa"' for i, axis in enumerate("xyz"))
    + "}\n"
    for k in range(3)
    for sign, level in ((-1, 0.0), (1, float(SIZE[k])))
)


def plane(k: int, y: Array, z: Array) -> Array:
    """Place x of plane k at (y, z)."""
    x, a, b = PLANES[k]
    return x + a * (y - 0.5 * SIZE[1]) + b * (z - 0.5 * SIZE[2])


def mapped(k: int, unit: Array) -> Array:
    """Points (n, 3) of the unit cube in block k."""
    y, z = unit[:, 1] * SIZE[1], unit[:, 2] * SIZE[2]
    return np.stack([(1 - unit[:, 0]) * plane(k, y, z) + unit[:, 0] * plane(k + 1, y, z), y, z], axis=1)


def patch() -> tuple[Specimen, TetMesh]:
    """Three blocks; nodes inside them are moved about."""
    rng, line = np.random.default_rng(3), np.linspace(0.0, 1.0, CELLS + 1)
    cube = MeshTet.init_tensor(line, line, line)
    corners = np.array([[k & 1, k >> 1 & 1, k >> 2] for k in range(8)], dtype=float)
    polyhedra, nodes, tets = [], [], []
    for k in range(3):
        polyhedra.append([mapped(k, corners)[list(face)] for face in FACES])
        unit = cube.p.T.copy()
        inside = np.all((unit > NEAR) & (unit < 1 - NEAR), axis=1)
        unit[inside] += rng.uniform(-0.2, 0.2, (inside.sum(), 3)) / CELLS
        place, tet = mapped(k, unit), cube.t.T.astype(np.int64)
        over = np.linalg.det(place[tet[:, 1:]] - place[tet[:, :1]]) < 0
        tet[over] = tet[over][:, [1, 0, 2, 3]]
        nodes.append(place)
        tets.append(tet + k * len(place))
    blocks = from_faces(polyhedra, range(3), [0] * 3, ("units",))
    starts = [np.arange(4) * len(part[0]) for part in (nodes, tets)]
    mesh = TetMesh(np.concatenate(nodes), starts[0], np.concatenate(tets), starts[1])
    return Specimen(blocks, {"patch": np.arange(3)}, 1.0), mesh


def exact(place: Array, block: Array) -> Array:
    """(n, 3) m."""
    strain = ((1 + POISSON) * STRESS - POISSON * np.trace(STRESS) * np.eye(3)) / YOUNG
    jumps = [np.zeros(3)]
    for _, a, b in PLANES[1:3]:
        n = np.array([1.0, -a, -b]) / np.sqrt(1 + a * a + b * b)
        traction = STRESS @ n
        sn = n @ traction
        jumps.append(jumps[-1] + n * sn / KN + (traction - n * sn) / KS)
    return place @ strain.T + np.array(jumps)[block]


def without_rigid_motion(place: Array, error: Array) -> Array:
    """Errors (n, 3) less the shift and small turn that explain most of them."""
    rotations = [np.cross(axis, place) for axis in np.eye(3)]
    modes = np.stack([*(np.broadcast_to(axis, place.shape) for axis in np.eye(3)), *rotations], axis=-1).reshape(-1, 6)
    modes = modes / np.abs(modes).max(axis=0)
    return error.ravel() - modes @ np.linalg.lstsq(modes, error.ravel(), rcond=None)[0]


def hold_three_nodes(conditions: Conditions, layout: Layout) -> None:
    """Six dofs of three corners of the first block, in place of the scene's support."""
    assert layout.mesh is not None
    supports = np.zeros_like(conditions.prescribed["tets"])
    for corner, axes in (([0, 0, 0], [0, 1, 2]), ([0, 1, 0], [0, 2]), ([0, 0, 1], [0])):
        at = PLANES[0][0], *(SIZE[1:] * corner[1:])
        gap = np.linalg.norm(layout.mesh.nodes - at, axis=1)
        supports[int(np.argmin(gap)), axes] = True
    conditions.prescribed["tets"] = supports
    conditions.supported["tets"] = supports.copy()


def explicit(findings: Findings, specimen: Specimen, mesh: TetMesh) -> float:
    """Largest error of a run's nodes (m)."""
    assembly = rebuilt(assembled(SCENE, specimen, mesh), hold_three_nodes)
    outcome = timeloop.run(assembly.model, assembly.plan, assembly.recording)
    result = findings.note("patch", laboratory.result_of(assembly, outcome))
    block = np.repeat(np.arange(3), np.diff(mesh.node_start))
    error = result.history.frames[-1].nodes - exact(mesh.nodes, block)
    return float(np.abs(without_rigid_motion(mesh.nodes, error)).max())


def implicit(mesh: TetMesh, degree: int, rule: str | int) -> float:
    """Largest error of the dofs of the interface model (m)."""
    block = np.repeat(np.arange(3), np.diff(mesh.tet_start))
    law = Law("elastic", KN, KS)
    assembled = model(solid(mesh.nodes, mesh.tets, block), YOUNG, POISSON, lambda a, b: law, degree, rule)
    assembled.hold("xyz", lambda x, b: np.any((x < NEAR) | (x > SIZE - NEAR), axis=1))
    truth = exact(assembled.place, assembled.block)[np.arange(len(assembled.axis)), assembled.axis]
    assembled.driven = np.where(assembled.held, truth, 0.0)
    path = EquilibriumPath(assembled)
    path.go(1.0)
    return float(np.abs(path.displacements() - truth).max())


def run() -> Findings:
    """Errors of all nodes, over the largest displacement."""
    findings, (specimen, mesh) = Findings(), patch()
    size = float(np.abs(exact(mesh.nodes, np.repeat(np.arange(3), np.diff(mesh.node_start)))).max())
    why = "the field is in the space of both elements, and both rules integrate it: rounding"
    for name, degree, rule in (("linear, vertices", 1, "vertex"), ("linear, Gauss", 1, 4), ("quadratic, Gauss", 2, 4)):
        value = implicit(mesh, degree, rule)
        tolerance = Tolerance(1e-12, 1e-14, why)
        findings.check(f"interface model, {name}: largest error", "m", value, 0.0, tolerance, scale=size)
    value = explicit(findings, specimen, mesh)
    tolerance = Tolerance(1e-12, 1e-14, "as above, and how far the run comes to rest")
    findings.check("run, points at nodes: largest error", "m", value, 0.0, tolerance, scale=size)
    wrong = implicit(mesh, 2, "vertex") / size
    findings.remarks.append(f"quadratic tets with points at the corners, which fail by rule: error {wrong:.2%}")
    return findings


CASE = Case(
    "patch-of-distorted-blocks",
    "A1",
    "Patch of three distorted blocks under uniform stress",
    area="Elastic assemblies",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="linear and at rest: exact on any mesh",
)
