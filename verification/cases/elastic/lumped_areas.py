"""Areas of contact points: they add up to the face, and carry its first moments.

    on nodes of a mesh                      3 ______ 2       a triangle gives a third of its area to each corner, so a
    (blocks of tets)                         |   / |         square cut along a diagonal gives 1/3 to the two corners on
                                             | /   |         the diagonal and 1/6 to the two others; the first moments
                                            0|/____|1        about the middle vanish all the same
    "vertex", n points along an edge:        Gauss-Lobatto weights, exact to the power 2 n - 3
    "gauss", n points along an edge:         exact to the power 2 n - 1

Reference: by hand; integrals of polynomials over a square.
"""

import numpy as np

from geometry.joints.find import find_joints
from geometry.meshes.fan import mesh_by_fans
from geometry.polyhedra.construct import from_faces
from verification.case import Case, Findings, Tolerance
from verification.fixtures import shapes

SIDES = (0.2, 0.1)
AREA = SIDES[0] * SIDES[1]
ROUNDING = Tolerance(1e-13, 1e-15, "sums of products: rounding")
CLIPPED = Tolerance(1e-12, 1e-15, ROUNDING.reason)


def moments(findings: Findings, words: str, point: np.ndarray, area: np.ndarray, second: float, exact: str) -> None:
    """Sum, first moments and second moment along x about the middle of the face."""
    arm = point[:, :2] - 0.5 * np.array(SIDES)
    findings.check(f"{words}: sum", "m2", area.sum(), AREA, ROUNDING)
    value = np.abs(area @ arm).max()
    findings.check(f"{words}: first moments, largest", "m3", value, 0.0, ROUNDING, scale=AREA * SIDES[0])
    value = area @ arm[:, 0] ** 2 / (AREA * SIDES[0] ** 2 / 12)
    findings.check(f"{words}: second moment over that of the face", "1", value, second, Tolerance(1e-13, 1e-15, exact))


def partly(findings: Findings) -> None:
    """Area and middle of each joint of a wall in running bond, and of two squares, one of them turned."""
    joints = find_joints(shapes.wall(2, 2, (0.2, 0.1, 0.08)))
    bed, head = 0.1 * 0.1, 0.1 * 0.08
    wanted = {
        (0, 1): (head, (0.2, 0.05, 0.04)),
        (2, 3): (head, (0.3, 0.05, 0.12)),
        (0, 2): (bed, (0.15, 0.05, 0.08)),
        (1, 2): (bed, (0.25, 0.05, 0.08)),
        (1, 3): (bed, (0.35, 0.05, 0.08)),
    }
    pair = list(zip(joints.block_a.tolist(), joints.block_b.tolist(), strict=True))
    findings.check("running bond: joints", "1", len(set(pair)), len(wanted), Tolerance(1e-14, 0.0, "a count: exact"))
    for (a, b), (area, middle) in wanted.items():
        own = np.array([p == (a, b) for p in pair])
        size = float(joints.area[own].sum())
        off = np.abs(joints.area[own] @ joints.point[own] / area - middle).max()
        findings.check(f"running bond: joint of {a} and {b}", "m2", size, area, CLIPPED)
        findings.check(f"running bond: middle of the joint of {a} and {b}, off by", "m", off, 0.0, CLIPPED, scale=0.1)
    side, quarter = 0.1, np.sqrt(0.5)
    two = shapes.stack([side, side], (side, side))
    centre = np.array([side / 2, side / 2, 0.0])
    rotation = np.array([[quarter, -quarter, 0.0], [quarter, quarter, 0.0], [0.0, 0.0, 1.0]])
    upper = [(face - centre) @ rotation.T + centre for face in shapes.faces_of(two, 1)]
    blocks = from_faces([shapes.faces_of(two, 0), upper], [0, 1], [0, 0], ("units",))
    octagon = 2.0 * (np.sqrt(2.0) - 1.0) * side**2
    findings.check("a square on a turned one", "m2", find_joints(blocks).area.sum(), octagon, CLIPPED)


def run() -> Findings:
    """Rules of points on a rectangle, nodes of two meshes, a triangle, and faces that overlap in part."""
    findings = Findings()
    partly(findings)
    blocks = shapes.stack([0.05, 0.05], SIDES)
    for n in (2, 3, 4, 9):
        joints = find_joints(blocks, rule="vertex", points_per_edge=n)
        moments(findings, f"vertex, {n} x {n} points", joints.point, joints.area, 3.0 if n == 2 else 1.0,
                "ends alone have three times as much, from three points on it is exact: rounding")  # fmt: skip
        joints = find_joints(blocks, points_per_edge=n)
        moments(
            findings, f"gauss, {n} x {n} points", joints.point, joints.area, 1.0, "exact from two points on: rounding"
        )
    fan = mesh_by_fans(blocks, np.array([True, True]), find_joints(blocks))[1]
    corner = np.array([(x, y) for x in (0.0, SIDES[0]) for y in (0.0, SIDES[1])])
    fraction = np.sort([fan.area[np.abs(fan.point[:, :2] - c).max(axis=1) < 1e-12].sum() / AREA for c in corner])
    for k, wanted in enumerate((1 / 6, 1 / 6, 1 / 3, 1 / 3)):
        findings.check(f"two triangles: share of corner {k + 1} in order", "1", fraction[k], wanted, ROUNDING)
    for size in (1.0, 0.03, 0.011):
        joints = shapes.setup(blocks, ["tets", "tets"], mesh_size=size).joints
        arm = joints.point[:, :2] - 0.5 * np.array(SIDES)
        words = f"mesh of {1e3 * size:g} mm, {len(joints.area)} nodes on the face"
        findings.check(f"{words}: sum", "m2", joints.area.sum(), AREA, ROUNDING)
        value = np.abs(joints.area @ arm).max()
        findings.check(f"{words}: first moments, largest", "m3", value, 0.0, ROUNDING, scale=AREA * SIDES[0])
    return findings


CASE = Case(
    "lumped-areas",
    "A4",
    "Areas of contact points",
    area="Elastic assemblies",
    run=run,
    quick=True,
    no_problems="geometry alone: nothing is run",
)
