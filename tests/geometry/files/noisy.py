"""Structures as surfaces that are turned at random and have lost digits, and how far their joints are off."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from geometry.blocks import Blocks, GeometryError, Imported, Specimen
from geometry.cells.domain import box_domain
from geometry.cells.power import tessellate
from geometry.cells.power_blocks import to_blocks
from geometry.files.export import export
from geometry.files.surfaces.reader import read_surfaces
from geometry.joints.find import find_joints
from geometry.joints.heal import mend
from geometry.polyhedra.construct import from_faces
from geometry.polyhedra.measures import centroids
from geometry.polyhedra.overlaps import check_overlaps
from geometry.polyhedra.validate import require_sound
from geometry.polyhedra.weld import weld
from geometry.structures.arch import arch
from geometry.structures.dome import dome
from geometry.structures.vault import vault
from geometry.structures.wall import wall
from masonry.importing.importing import FLAT
from tests.geometry.structures.drawing import joint_areas

TOLERANCE = 1e-4


def three_stones(random: np.random.Generator) -> Blocks:
    """Two stones on each other and a third one over both ends, whose joints lean."""
    lean = random.uniform(-0.3, 0.3, 3)
    level = np.cumsum([0.0, *random.uniform(0.2, 0.6, 3)])

    def stone(low: int, high: int) -> list[np.ndarray]:
        def ring(k: int) -> np.ndarray:
            corners = np.array([[0, 0], [0.4, 0], [0.4, 0.2], [0, 0.2]]) * (1 - 0.1 * k, 1)
            return np.column_stack([corners, level[k] + (lean[k - 1] * corners[:, 0] if k else 0 * corners[:, 0])])

        below, above = ring(low), ring(high)
        sides = [np.array([below[i], below[i - 3], above[i - 3], above[i]]) for i in range(4)]
        return [below[::-1], above, *sides]

    return from_faces([stone(k, k + 1) for k in range(3)], [0, 1, 2], [0] * 3, ["units"])


def bricks(random: np.random.Generator) -> Blocks:
    sizes = {"length": 1.0, "height": 5 * 0.09, "thickness": 0.12}
    unit = {"unit_length": 0.24, "unit_height": 0.08, "joint_thickness": 0.01}
    return wall(**sizes, **unit, base=0.1).blocks


def voussoirs(random: np.random.Generator) -> Blocks:
    angle = float(np.radians(random.uniform(60, 170)))
    return arch(1.2, angle, int(random.integers(3, 25)), float(random.uniform(0.08, 0.3)), 0.3).blocks


def shell(random: np.random.Generator) -> Blocks:
    return dome(radius=1.0, thickness=0.2, courses=4, voussoirs=6, crown=0.25).blocks


def barrel(random: np.random.Generator) -> Blocks:
    return vault(
        radius=1.2, angle=float(np.radians(150)), courses=7, thickness=0.2, length=2.0, units_per_course=3
    ).blocks


def cells(random: np.random.Generator) -> Blocks:
    """Cells of random sites that have moved to the middles of their cells, so that few faces are tiny."""
    low, high = np.zeros(3), np.array([1.0, 0.5, 0.6])
    domain, sites = box_domain(low, high), random.uniform(low, high, (30, 3))
    for _ in range(15):
        power = tessellate(sites, np.zeros(len(sites)), domain)
        blocks = to_blocks(power, np.arange(len(sites)))
        sites = centroids(blocks)
    return blocks


def clad_roof(random: np.random.Generator) -> Blocks:
    """A hipped roof, whose ridge is far shorter than the tolerance, and a stone on either hip."""
    x, y, z, ridge = 0.1, 0.15, 0.1, random.uniform(0.5e-5, 1e-5)
    a, b, c, d = np.array([[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]])
    e, f = np.array([[-ridge, 0, z], [ridge, 0, z]])
    hips = [np.array([b, c, f]), np.array([d, a, e])]
    stones = [[np.array([d, c, b, a]), np.array([a, b, f, e]), np.array([c, d, e, f]), *hips]]
    for hip in hips:
        apex = hip.mean(axis=0) + 0.3 * np.cross(hip[1] - hip[0], hip[2] - hip[0]) / z
        stones.append([hip[::-1], *(np.array([hip[k - 1], hip[k], apex]) for k in range(3))])
    return from_faces(stones, range(3), [0] * 3, ["units"])


STRUCTURES: tuple[Callable[[np.random.Generator], Blocks], ...] = (
    three_stones,
    bricks,
    voussoirs,
    shell,
    barrel,
    cells,
)


def turned(blocks: Blocks, random: np.random.Generator, far: float = 2.0) -> Blocks:
    """The blocks, each with corners of its own, turned and moved at random by up to far (m) along each axis."""
    corner = np.split(blocks.points[blocks.face_points], blocks.face_start[blocks.block_face_start[1:-1]])
    welded = [weld(part, 1e-9) for part in corner]
    first = np.cumsum([0, *(len(chosen) for chosen, _ in welded)])
    number = np.concatenate([n + k for (_, n), k in zip(welded, first, strict=False)])
    points = np.concatenate([part[chosen] for part, (chosen, _) in zip(corner, welded, strict=True)])
    blocks = replace(blocks, points=points, face_points=number)
    turn = Rotation.random(random_state=int(random.integers(2**31)))
    return replace(blocks, points=turn.apply(blocks.points) + random.uniform(-far, far, 3))


def rounded(blocks: Blocks, noise: float | None, random: np.random.Generator) -> Blocks:
    """Corners in single precision; or moved by up to a noise (m) along each axis, those of each block on their own."""
    if noise is None:
        return replace(blocks, points=blocks.points.astype(np.float32).astype(float))
    return replace(blocks, points=blocks.points + random.uniform(-noise, noise, blocks.points.shape))


def read_again(blocks: Blocks, path, tolerance: float = TOLERANCE) -> tuple[Blocks, Imported]:
    """What an import makes of blocks that were written to a file; asks that it is sound and overlaps nowhere."""
    export(path, Specimen(blocks))
    refused: GeometryError | None = None
    for share in FLAT:
        solids = read_surfaces(path, 1.0, flat=share * tolerance)
        try:
            mended = mend(solids.blocks, tolerance, [f"block {b}" for b in range(solids.blocks.count)])
            break
        except GeometryError as error:
            refused = refused or error
    else:
        raise refused
    require_sound(mended.blocks)
    check_overlaps(mended.blocks, allowed=mended.deepest)
    return mended.blocks, solids


def worst_joint(exact: Blocks, noisy: Blocks) -> tuple[float, int, int]:
    """The largest change of area of two blocks' joint over its perimeter (m), and how many joints came or went.

    Joints that are narrower than the tolerance, by twice the area over the perimeter, are not mended and not asked for.
    """
    one, two = find_joints(exact), find_joints(noisy)
    before, after = joint_areas(one), joint_areas(two)
    around: dict[tuple[int, int], float] = {}
    sides = np.zeros((len(one.patch_start) - 1, 2), dtype=int)
    sides[one.patch] = np.stack([one.block_a, one.block_b], axis=1)
    for j, (a, b) in enumerate(sides.tolist()):
        ring = one.patch_points[one.patch_start[j] : one.patch_start[j + 1]]
        around[a, b] = around.get((a, b), 0.0) + float(np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1).sum())
    broad = {pair: area for pair, area in before.items() if 2 * area > TOLERANCE * around[pair]}
    change = [abs(after.get(pair, 0.0) - area) / around[pair] for pair, area in broad.items()]
    return max(change, default=0.0), len(set(broad) - set(after)), len(set(after) - set(before))
