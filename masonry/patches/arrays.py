"""Data of patches: the points where pairs touch, what holds where they do, how blocks move, and how a search or a step
ends. Pairs themselves: pairs.py."""

from typing import Any, NamedTuple

import numpy as np

from masonry.detection.broad import BoxGrid
from masonry.detection.overlap import Scratch
from masonry.detection.pieces import ConvexPieces
from masonry.detection.placing import TurnedPieces
from masonry.jit.compiler import inlined, inner
from masonry.patches.pairs import PatchPairs
from masonry.simd import FOUR

PLACE, LEVEL, AREA, SHEAR = 0, 3, 4, 5
"""Rows of PatchPoints.quads."""
FRICTION, DASHPOT, SHEAR_LOST, NORMAL_GAINED, BORN, CRUSHED = range(6)
"""Of Near.account (J): dissipated by friction and by dashpots; lost as shear went to new points; gained as the areas of
points that press changed, and by points that were born pressing; dissipated by crushing."""
REASON, PAIR, ROOM = range(3)
"""Of Search.refusal: why no step was taken, the pair that is to blame, and for how many pairs there must be room."""
NEED_POINTS, NEED_PAIRS, TOO_DEEP = 1, 2, 3
"""Reasons: no free slot, no room for pairs, or a contact that was born with a deep overlap."""
SEARCHES, LOOKS = range(2)
"""Of Search.tally: how many there were so far."""


class PatchPoints(NamedTuple):
    """Points of the pairs that touch, or nearly: S slots of up to K points, a multiple of four; which slots are free.

    number   (S,) points of a slot
    quads    (K / FOUR, S, 8, FOUR) what each step needs of four points, side by side in memory, and so are the first
             four of all slots: most have no more, and a step reads them in one stream; in rows from
             PLACE   m, x, y, z from the centroid of the block that they belong to, in its frame
             LEVEL   m, of the plane that the point meets, along the normal from the centroid of the reference
             AREA    m2
             SHEAR   Pa, x, y, z of the elastic shear traction on the reference, in space
    feature  (S, K) names
    damper   (K / FOUR, S, FOUR) Pa, stress of the dashpot at the last step
    branches  (S, K / FOUR, 3 J, FOUR) Pa on the reference, x, y, z of each branch: branches.py; None without any
    crushed  (S, K / FOUR, ROWS, FOUR) plastic closing and its hardening: crushed_points.py; None where nothing crushes
    free     (S + 1,) the last number is how many slots are free, the first ones which
    """

    number: np.ndarray
    quads: np.ndarray
    feature: np.ndarray
    damper: np.ndarray
    branches: np.ndarray | None
    crushed: np.ndarray | None
    free: np.ndarray


class Rules(NamedTuple):
    """Rules for two groups of blocks that meet, (R,) each: Pa/m, Pa/m, tangent, share of critical damping, and the
    residual cohesion (Pa) of faces that touch; None where no table has any. keep, gain (J,) of the branches beside the
    springs: branches.py; None without any. rise (R, 3) where a restitution is given, 0 else: by how much more of
    critical a dashpot needs in an impact of w (1/s), over w and its square, and the most w. cap (R, 4) strength in
    compression (Pa), energy (N/m), closing at its peak (m) and weight of shear; cut_off (R, 2) strength and energy, inf
    where nothing softens: crushed_points.py; 0 in the rows of others, None without any."""

    normal_stiffness: np.ndarray
    shear_stiffness: np.ndarray
    tan_friction: np.ndarray
    dashpot: np.ndarray
    cohesion: np.ndarray | None = None
    keep: np.ndarray | None = None
    gain: np.ndarray | None = None
    rise: np.ndarray | None = None
    cap: np.ndarray | None = None
    cut_off: np.ndarray | None = None


class BlockMotion(NamedTuple):
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
    """Data of the search for contacts.

    group, unit (B,) of each block      law_of (G, G, 2) row of Rules for two groups, of two units or of one
    bonded   (K,) sorted, a * N + b of the blocks a < b that bonds hold together: patches are not looked for there;
             N pieces in all; alive (K,) whether they still do
    free     (B,) whether forces can move it          moves  (B,) whether these can, or a drive
    mass     (B,) kg, real; where some blocks are `meshed` kg/m2, behind a face of a cube of the block's volume
    minimum_area (B,) m2, area of a contact of edges     deep (B,) m, its side for the whole block
    position (B, 3) m, of centroids: all in space for a search, of two blocks from the first of them for a look
    built    (B,) m, travel at the last search      skin (1,) m
    spread   whether patches have a point inside for each at their corners
    rounds   (m, 2) of detection/spread.py, where they have more of them; else of one round
    candidates  (F, 2) room for the pairs that a search finds
    losers   (F,) room for the pairs that lost normal energy in the looks of a step
    listed   (1,) whether each block's pairs are listed as they are: first_pair (B,), next_pair (F, 2):
    first_pair, next_pair   sunk_edges.list_pairs
    patches  (F,) room for how many patches lie on each face
    stale    (F,) faces whose patches are all looked at in this step; (B,) the same of blocks: refreshing.py
    stale_block
    refusal  (3,) why no step was taken: REASON, PAIR, ROOM
    tally    (2,) how often was searched and looked: SEARCHES, LOOKS
    """

    group: np.ndarray
    unit: np.ndarray
    law_of: np.ndarray
    bonded: np.ndarray
    alive: np.ndarray
    free: np.ndarray
    moves: np.ndarray
    mass: np.ndarray
    meshed: bool
    minimum_area: np.ndarray
    deep: np.ndarray
    position: np.ndarray
    built: np.ndarray
    skin: np.ndarray
    spread: bool
    rounds: np.ndarray
    candidates: np.ndarray
    losers: np.ndarray
    listed: np.ndarray
    first_pair: np.ndarray
    next_pair: np.ndarray
    patches: np.ndarray
    stale: np.ndarray
    stale_block: np.ndarray
    refusal: np.ndarray
    tally: np.ndarray


class Footprint(NamedTuple):
    """Room for up to K points of one patch, as a look finds them: (K, 3) m, (K,) m, (K,) m2, names (K,), and (K, 3) Pa
    on side 0."""

    point: np.ndarray
    gap: np.ndarray
    area: np.ndarray
    feature: np.ndarray
    shear: np.ndarray


class FormerPatch(NamedTuple):
    """Room for what a patch was before that look: its normal (3,) from side 0 to side 1, and points as of Footprint."""

    normal: np.ndarray
    point: np.ndarray
    area: np.ndarray
    feature: np.ndarray
    shear: np.ndarray


class Near(NamedTuple):
    """All of what blocks meet; `before` is room for the pairs of the last search; account (6,) J; crushed (of
    crushed_faces.py) is None where nothing crushes."""

    pieces: ConvexPieces
    turned: TurnedPieces
    cells: BoxGrid
    pairs: PatchPairs
    before: PatchPairs
    points: PatchPoints
    rules: Rules
    motion: BlockMotion
    search: Search
    footprint: Footprint
    former: FormerPatch
    scratch: Scratch
    account: np.ndarray
    crushed: Any = None


def places_alone(near: Near) -> Near:
    """Near without points, rules and what only some blocks have: parts that ask where pieces are, and no more, are
    compiled for this once for all scenes."""
    absent: Any = None
    motion = near.motion._replace(dual=absent, rate=absent, strain=absent)
    return near._replace(points=absent, rules=absent, motion=motion, crushed=absent)


@inner
def number_of(points, s, k, row):
    """A number of point k of slot s."""
    return points.quads[k // FOUR, s, row, k % FOUR]


@inner
def vector_of(points, s, k, row):
    """Three numbers of point k of slot s, from a row on."""
    return number_of(points, s, k, row), number_of(points, s, k, row + 1), number_of(points, s, k, row + 2)


@inner
def put_number_of(points, s, k, row, value):
    """Write a number of point k of slot s."""
    points.quads[k // FOUR, s, row, k % FOUR] = value


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


@inlined
def between(centre, moved, ref, other):
    """m, from the centroid of one block to that of another: the sums of the places would lose digits far away."""
    return (
        (centre[other, 0] - centre[ref, 0]) + (moved[other, 0] - moved[ref, 0]),
        (centre[other, 1] - centre[ref, 1]) + (moved[other, 1] - moved[ref, 1]),
        (centre[other, 2] - centre[ref, 2]) + (moved[other, 2] - moved[ref, 2]),
    )


@inner
def outward(owner):
    """1 where the normal out of the reference points from side 0 to side 1: where the points are those of side 1."""
    return 1.0 if owner == 1 else -1.0


def no_points(room: int, number: int, branches: int = 0, crushed: int = 0) -> PatchPoints:
    """Room for the points of so many pairs, `number` each, so many branches and numbers of crushing; none in it."""
    number = -(-number // 4) * 4
    return PatchPoints(
        number=np.zeros(room, dtype=np.int64),
        quads=np.zeros((number // FOUR, room, 8, FOUR)),
        feature=np.zeros((room, number), dtype=np.int64),
        damper=np.zeros((number // FOUR, room, FOUR)),
        branches=np.zeros((room, number // FOUR, 3 * branches, FOUR)) if branches else None,
        crushed=np.zeros((room, number // FOUR, crushed, FOUR)) if crushed else None,
        free=np.append(np.arange(room)[::-1], room).astype(np.int64),
    )


def no_footprint(number: int) -> Footprint:
    """Room for so many points."""
    return Footprint(
        np.zeros((number, 3)),
        np.zeros(number),
        np.zeros(number),
        np.zeros(number, dtype=np.int64),
        np.zeros((number, 3)),
    )


def no_former_patch(number: int) -> FormerPatch:
    """Room for a patch of so many points."""
    return FormerPatch(
        np.zeros(3), np.zeros((number, 3)), np.zeros(number), np.zeros(number, dtype=np.int64), np.zeros((number, 3))
    )
