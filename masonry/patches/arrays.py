"""What patches are made of: pairs of pieces that are near, the points where they touch, and how blocks move."""

from typing import NamedTuple

import numpy as np

from masonry.detection.broad import Cells
from masonry.detection.overlap import Scratch
from masonry.detection.pieces import Pieces
from masonry.detection.placing import Turned
from masonry.jit.compiler import inlined, inner
from masonry.simd import FOUR

PLACE, LEVEL, AREA, SHEAR = 0, 3, 4, 5
"""Rows of Points.quads."""


class Pairs(NamedTuple):
    """Pairs of convex pieces that are near to each other, sorted; there is room for more than there are.

    number    (1,) how many there are; the arrays below have a row for each
    piece     (P, 2) numbers of the pieces, the lower first     body  (P, 2) their blocks
    slot      (P,) where its points are kept; -1 where the two are apart
    points_of (P,) which side the points belong to (0, 1); the plane is fixed in the other one, the reference
    normal    (P, 3) of the plane, out of the reference, in its frame
    axis      (P, 3) that of the last look, from side 0 to side 1, in space
    witness   (P, 3) of that look (detection/narrow.py)
    mark      (P,) m, travel of both blocks at the last look     limit  (P,) m, that after which it is looked at again
    reach     (P,) m, how far they may move against each other until the next look
    pose      (P, 12) how they stood to each other at the last one (relative_motion.py)
    law       (P,) row of Rules    dashpot (P,) Pa s/m
    slack     (P,) m, by which its points press less than they overlap, or more (below 0): slack.py
    gained    (P,) J, normal energy that the last look gave or took, until slack.py has settled it; 0 otherwise
    damped    (P,) J, what its dashpot has dissipated since the two touch, less what it has paid: slack.py
    face      (P, 2) its two faces before that look, -1 for edges
    """

    number: np.ndarray
    piece: np.ndarray
    body: np.ndarray
    slot: np.ndarray
    points_of: np.ndarray
    normal: np.ndarray
    axis: np.ndarray
    witness: np.ndarray
    mark: np.ndarray
    limit: np.ndarray
    reach: np.ndarray
    pose: np.ndarray
    law: np.ndarray
    dashpot: np.ndarray
    slack: np.ndarray
    gained: np.ndarray
    damped: np.ndarray
    face: np.ndarray


class Points(NamedTuple):
    """Points of the pairs that touch, or nearly: S slots of up to K points, a multiple of four; which slots are free.

    held     (S,) points of a slot
    quads    (S, K / FOUR, 8, FOUR) what each step needs of four points, side by side in memory; in rows from
             PLACE   m, x, y, z from the centroid of the block that they belong to, in its frame
             LEVEL   m, of the plane that the point meets, along the normal from the centroid of the reference
             AREA    m2
             SHEAR   Pa, x, y, z of the elastic shear traction on the reference, in space
    feature  (S, K) names
    damper   (S, K) Pa, stress of the dashpot at the last step
    free     (S + 1,) the last number is how many slots are free, the first ones which
    """

    held: np.ndarray
    quads: np.ndarray
    feature: np.ndarray
    damper: np.ndarray
    free: np.ndarray


class Rules(NamedTuple):
    """What two groups of blocks do where they meet, (R,) each: Pa/m, Pa/m, tangent, share of critical damping, and the
    residual cohesion (Pa) of faces that touch; None where no table has any."""

    normal_stiffness: np.ndarray
    shear_stiffness: np.ndarray
    tan_friction: np.ndarray
    dashpot: np.ndarray
    cohesion: np.ndarray | None = None


class Motion(NamedTuple):
    """How B blocks stand and move: rigid ones, or with `dual` and what follows blocks of which some deform.

    Rows of moved, v and push may have more room than numbers.

    centre  (B, 3) m, centroids of the undeformed shape     moved (B, 6) m, the first three: how far they are from there
    frame   (B, 3, 3) rotation from the start, or deformation gradient F
    v       (B, 6) velocity and spin about x, y, z
    push    (B, 6) out: force and moment about the centroid; (B, 12) force and first moments where blocks deform
    radius  (B,) m, of the sphere about the centroid that holds the block
    travel  (B,) m, bound of how far any point has moved so far
    dual    (B, 3, 3) F^-T, which carries normals; None where all blocks are rigid, and so are the next two
    rate    (B, 3, 3) 1/s, F'
    strain  (B,) 1/s, norm of the rate of stretching: the symmetric part of F' F^-1
    """

    centre: np.ndarray
    moved: np.ndarray
    frame: np.ndarray
    v: np.ndarray
    push: np.ndarray
    radius: np.ndarray
    travel: np.ndarray
    dual: np.ndarray | None = None
    rate: np.ndarray | None = None
    strain: np.ndarray | None = None


class Search(NamedTuple):
    """What looking for contacts needs.

    group, unit (B,) of each block      law_of (G, G, 2) row of Rules for two groups, of two units or of one
    bonded   (K,) sorted, a * N + b of the blocks a < b that bonds hold together: patches are not looked for there;
             N pieces in all; held (K,) whether they still do
    moves    (B,) whether it can move
    mass     (B,) kg, real; where some blocks are `meshed` kg/m2, behind a face of a cube of the block's volume
    least    (B,) m2, area of a contact of edges     deep (B,) m, its side for the whole block
    position (B, 3) m, of centroids: all in space for a search, of two blocks from the first of them for a look
    built    (B,) m, travel at the last search      skin (1,) m
    spread   whether patches have points inside besides those at their corners
    point, gap, area, feature, shear  room for what one look finds: (K, 3) m, m, m2, names, and (K, 3) Pa on side 0
    was_normal, was_point, was_shear, was_area, was_feature  (3,), (K, 3) m, (K, 3) Pa, (K,) m2, (K,) what a patch was
    found    (F, 2) room for the pairs that a search finds
    patches  (F,) room for how many patches lie on each face
    stale    (F,) faces whose patches are all looked at in this step; (B,) the same of blocks: refreshing.py
    stale_block
    flag     (4,) why no step was taken, the pair to blame; searches and looks so far
    """

    group: np.ndarray
    unit: np.ndarray
    law_of: np.ndarray
    bonded: np.ndarray
    held: np.ndarray
    moves: np.ndarray
    mass: np.ndarray
    meshed: bool
    least: np.ndarray
    deep: np.ndarray
    position: np.ndarray
    built: np.ndarray
    skin: np.ndarray
    spread: bool
    point: np.ndarray
    gap: np.ndarray
    area: np.ndarray
    feature: np.ndarray
    shear: np.ndarray
    was_normal: np.ndarray
    was_point: np.ndarray
    was_shear: np.ndarray
    was_area: np.ndarray
    was_feature: np.ndarray
    found: np.ndarray
    patches: np.ndarray
    stale: np.ndarray
    stale_block: np.ndarray
    flag: np.ndarray


class Near(NamedTuple):
    """All of what blocks meet; `before` is room for the pairs of the last search; account (5,) J."""

    pieces: Pieces
    turned: Turned
    cells: Cells
    pairs: Pairs
    before: Pairs
    points: Points
    rules: Rules
    motion: Motion
    search: Search
    scratch: Scratch
    account: np.ndarray


@inner
def number_of(points, s, k, row):
    """A number of point k of slot s."""
    return points.quads[s, k // FOUR, row, k % FOUR]


@inner
def vector_of(points, s, k, row):
    """Three numbers of point k of slot s, from a row on."""
    return number_of(points, s, k, row), number_of(points, s, k, row + 1), number_of(points, s, k, row + 2)


@inner
def put_number_of(points, s, k, row, value):
    """Write a number of point k of slot s."""
    points.quads[s, k // FOUR, row, k % FOUR] = value


@inner
def put_vector_of(points, s, k, row, vector):
    """Write three numbers of point k of slot s, from a row on."""
    for i in range(3):
        put_number_of(points, s, k, row + i, vector[i])


@inlined
def joint_of(rules, law):
    """Normal and shear stiffness (Pa/m), tangent of friction, and cohesion (Pa) or None, of a row of rules."""
    row = np.uint64(law)
    kn, ks, tan = rules.normal_stiffness[row], rules.shear_stiffness[row], rules.tan_friction[row]
    return kn, ks, tan, row_of(rules.cohesion, row)


@inlined
def row_of(numbers, row):
    """A number of an array, or None where there is no array."""
    if numbers is None:
        return None
    return numbers[row]


@inner
def outward(own):
    """1 where the normal out of the reference points from side 0 to side 1: where the points are those of side 1."""
    return 1.0 if own == 1 else -1.0


def no_pairs(room: int) -> Pairs:
    """Room for so many pairs, and none in it."""
    numbers, twice, vectors = (room,), (room, 2), (room, 3)
    whole = {
        name: np.zeros(shape, dtype=np.int64) for name, shape in (("piece", twice), ("body", twice), ("law", numbers))
    }
    return Pairs(
        number=np.zeros(1, dtype=np.int64),
        slot=np.full(room, -1, dtype=np.int64),
        points_of=np.zeros(room, dtype=np.int64),
        normal=np.zeros(vectors),
        axis=np.zeros(vectors),
        witness=np.full(vectors, -1, dtype=np.int64),
        mark=np.zeros(room),
        limit=np.zeros(room),
        reach=np.zeros(room),
        pose=np.zeros((room, 12)),
        dashpot=np.zeros(room),
        slack=np.zeros(room),
        gained=np.zeros(room),
        damped=np.zeros(room),
        face=np.full(twice, -1, dtype=np.int64),
        **whole,
    )


def no_points(room: int, most: int) -> Points:
    """Room for the points of so many pairs, `most` each, and none in it."""
    most = -(-most // 4) * 4
    return Points(
        held=np.zeros(room, dtype=np.int64),
        quads=np.zeros((room, most // FOUR, 8, FOUR)),
        feature=np.zeros((room, most), dtype=np.int64),
        damper=np.zeros((room, most)),
        free=np.append(np.arange(room)[::-1], room).astype(np.int64),
    )
