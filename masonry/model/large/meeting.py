"""A model of large displacement: blocks that turn, bonds in frames that turn with them, and what may meet.

It is made from the model of small displacement of the same scene: its dofs, masses, loads and contacts.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.polyhedra.indexing import following
from geometry.polyhedra.measures import face_areas_normals_centroids
from masonry.detection.broad import cells_for
from masonry.detection.overlap import most_points, scratch_of
from masonry.detection.pieces import ConvexPieces, pieces_of
from masonry.detection.placing import turned_of
from masonry.detection.spread import rounds_of
from masonry.detection.tet_pieces import FACES, SurfaceTets
from masonry.kernels.bonds import Bonds
from masonry.kernels.gathering import Members
from masonry.kinematics.rigid import Rigid
from masonry.kinematics.turning import Turning
from masonry.model.body_arrays import Bodies, in_rows
from masonry.model.element_plan import Dofs
from masonry.model.large.block_motion import (
    apart_on_ground,
    bodies_with,
    free_bodies,
    masses_behind,
    masses_of,
    motion_of,
    outer_tets,
    sizes_of,
)
from masonry.model.large.bodies import deforming, deforming_tets, turning
from masonry.model.large.row_sums import affine_row_sums, contact_row_sums, levers, tet_row_sums
from masonry.model.layout import DOFS, KINDS, Layout
from masonry.model.stable_step import Side, add_block_matrices, block_matrices
from masonry.patches.arrays import Near, Rules, Search, no_footprint, no_former_patch, no_points
from masonry.patches.crushed_faces import crushed_faces
from masonry.patches.crushed_points import ROWS
from masonry.patches.pairs import no_pairs

LEAST = 1e-2
"""Of the area of a face of a cube of the block's volume: what a contact of two edges or a corner stands on."""


@dataclass(frozen=True)
class Meetings:
    """How blocks meet: `rules`, and law_of (G, G, 2), which of them serves two groups, of two units (0) or of one.

    skin    of the mean size of a block: how far blocks may come nearer before all pairs are found anew
    branches  of dashpots beside the springs
    spread  whether patches have points inside besides those at their corners
    along   how many points a patch has along its edges
    """

    rules: Rules
    law_of: np.ndarray
    skin: float
    spread: bool = False
    branches: int = 0
    along: int = 2

    @property
    def crushes(self) -> bool:
        """Whether any two blocks may crush where they meet."""
        return self.rules.cap is not None or self.rules.cut_off is not None

    @property
    def rounds(self) -> int:
        """Points of a patch for each of its corners."""
        return 2 if self.spread else self.along // 2

    @property
    def stiffest(self) -> float:
        """Pa/m: the largest stiffness, normal or in shear."""
        return float(max(rule.max(initial=0.0) for rule in self.rules[:2]))

    @property
    def step_fraction(self) -> float:
        """Of the stable step that dashpots leave, which act on velocities half a step old."""
        ratios = self.rules.dashpot
        if self.rules.rise is not None:  # what its own step adds at most
            length = np.minimum(2.0 * (np.hypot(1.0, ratios) - ratios), self.rules.rise[:, 2])
            ratios = ratios + self.rules.rise[:, 0] * length + self.rules.rise[:, 1] * length**2
        damping_ratio = float(ratios.max(initial=0.0))
        return float(np.sqrt(1.0 + damping_ratio**2) - damping_ratio)

    def dashpots(self, mass: np.ndarray) -> np.ndarray:
        """(B,) Pa s/m, no less than any dashpot of blocks with a mass (B,) kg/m2 behind a face, whatever they meet."""
        stiffest = float((self.rules.dashpot * np.sqrt(self.rules.normal_stiffness)).max(initial=0.0))
        return 2.0 * stiffest * np.sqrt(mass)


@dataclass
class Large:
    """Additional data of a model of large displacement: bonds, and the separation (C, 3) m of their sides in the frame
    of side a, which is what their laws see; pieces that may meet, and the kinds of blocks if some deform."""

    bonds: Bonds
    parted: np.ndarray
    near: Near
    members: Members | None = None


def add_row_sums(
    sums: dict[str, np.ndarray],
    blocks: Blocks,
    layout: Layout,
    sides: tuple[Side, Side],
    length: np.ndarray,
    stiffness: np.ndarray,
    stiffest: float,
    lame: np.ndarray,
) -> None:
    """Row sums of the contacts of the undeformed shape, or of blocks whose faces all press, whichever are larger; and
    of the blocks' own stiffness.

    stiffness (C,) N/m; stiffest, Pa/m, of all ways in which blocks meet.
    """
    contact_row_sums(sums, sides, stiffness)
    for kind, values in face_row_sums(blocks, layout, length, np.full(blocks.count, stiffest)).items():
        np.maximum(sums[kind], values, out=sums[kind])
    affine_row_sums(sums["affine"], layout, lame[layout.members["affine"]], length)
    tet_row_sums(sums["tets"], layout, lame)


def face_row_sums(blocks: Blocks, layout: Layout, length: np.ndarray, per_area: np.ndarray) -> dict[str, np.ndarray]:
    """Row sums of blocks whose faces all press; per_area (B,) stiffness or dashpot of each, over its area.

    Every face counts over its whole area, on blocks with levers like their own, or of another kind with the longest
    that there are; its corners have the area of their share of the triangles between corners and centroid. A patch lies
    within the faces, and lumping a part of a face at its corners gives no larger sum of a convex function of the place
    than lumping the whole face does.
    """
    one, area, block = _pressed(blocks, layout, length)
    sums = {kind: np.zeros((layout.rows(kind), DOFS[kind])) for kind in KINDS}
    own = levers(one).sum(axis=1)
    others = np.array([own[one.kind != k].max(initial=0.0) for k in range(len(KINDS))])[one.kind]
    longer = 1.0 + 0.5 * np.maximum(others - own, 0.0) / (1.0 + own)
    contact_row_sums(sums, (one, one), 0.5 * per_area[block] * area * longer)  # both sides add to the same block
    return sums


def face_matrices(blocks: Blocks, layout: Layout, length: np.ndarray, per_area: float) -> dict[str, np.ndarray]:
    """Sums of J^T k J of blocks whose faces all press, as in `face_row_sums`; per_area, Pa/m, of all of them."""
    one, area, _ = _pressed(blocks, layout, length)
    matrices, stiffness = block_matrices(layout), per_area * area
    add_block_matrices(matrices, one, np.zeros((len(area), 3)), stiffness, stiffness)
    return matrices


def _pressed(blocks: Blocks, layout: Layout, length: np.ndarray) -> tuple[Side, np.ndarray, np.ndarray]:
    """The corners of all faces as the side of a contact, the area (m2) of each, and its block."""
    corner, area, block, row = _face_corners(blocks, layout)
    arm = np.einsum("cji,cj->ci", layout.axes[block], corner - layout.centroid[block])
    return Side(layout.kind[block], row, arm, layout.axes[block], length[block]), area, block


def _face_corners(blocks: Blocks, layout: Layout) -> tuple[np.ndarray, ...]:
    """Corners of all faces (c, 3) m, the area (m2) of each, its block, and row of its dofs (c,).

    Of meshed blocks the corners of the triangles at their surface: a patch lies in one triangle of each, so it gives no
    node more than its third of a triangle.
    """
    corner, after = blocks.points[blocks.face_points], following(blocks.face_start)
    face = np.repeat(np.arange(len(blocks.face_start) - 1), np.diff(blocks.face_start))
    arm = corner - face_areas_normals_centroids(blocks)[2][face]
    triangle, area = 0.5 * np.linalg.norm(np.cross(arm, arm[after]), axis=1), np.empty(len(corner))
    area[after] = 0.5 * (triangle[after] + triangle)
    owner = blocks.face_block()[face]
    plain = ~layout.meshed[owner]
    parts = [(corner[plain], area[plain], owner[plain], layout.local[owner[plain]])]
    tets = outer_tets(layout)
    if tets is not None:
        assert layout.mesh is not None
        which, face = np.nonzero(tets.outer)
        node = tets.node[which[:, None], np.array(FACES)[face]]
        place = layout.mesh.nodes[node]
        area = 0.5 * np.linalg.norm(np.cross(place[:, 1] - place[:, 0], place[:, 2] - place[:, 0]), axis=1)
        own = np.repeat(tets.block[which], 3)
        parts.append((place.reshape(-1, 3), np.repeat(area / 3.0, 3), own, node.ravel()))
    return tuple(np.concatenate(column) for column in zip(*parts, strict=True))


def pushed(bodies: Bodies, masses: dict[str, np.ndarray], apart: np.ndarray) -> Bodies:
    """Blocks that turn and deform, and are pushed by patches; `apart` (C, 3) is written at every step."""
    rigid, affine, tets = bodies
    return Bodies(
        None if rigid is None else turning_of(rigid, masses["rigid"][:, 3:], apart),
        None if affine is None else deforming(affine, apart)._replace(patches=in_rows(np.zeros(affine.q.shape))),
        None if tets is None else deforming_tets(tets, apart)._replace(patches=in_rows(np.zeros(tets.v.shape))),
    )


def turning_of(rigid: Rigid, inertia: np.ndarray, apart: np.ndarray) -> Turning:
    """Rigid blocks that turn, and are pushed by patches."""
    axes = np.broadcast_to(np.eye(3), (len(rigid.q), 3, 3)) if rigid.axes is None else rigid.axes
    return turning(rigid, inertia, apart)._replace(
        dt_over_mass=in_rows(_held_globally(rigid.dt_over_mass, axes)), patches=in_rows(np.zeros(rigid.q.shape))
    )


def _held_globally(dt_over_mass: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Pace (B, 6) whose turns are about x, y, z: a held principal axis lies along one of them."""
    along = np.abs(axes).argmax(axis=1)  # (B, 3): x, y or z of each principal axis
    pace = np.array(dt_over_mass)
    np.put_along_axis(pace[:, 3:], along, dt_over_mass[:, 3:], axis=1)
    return pace


def without_sides(
    bodies: Bodies, contacts: int, ends: Sequence[np.ndarray] = ()
) -> tuple[Bodies, tuple[np.ndarray, ...]]:
    """Rigid bodies without the sides of so many contacts: patches replace them, or bonds of two blocks push as one. And
    rows of u of the ends (E,) of each element as they are then: the first of the points."""
    body = bodies.rigid
    keeps = body.code >> 1 >= contacts
    before = np.concatenate([[0], np.cumsum(keeps)])
    body = body._replace(
        start=before[body.start].astype(body.start.dtype),
        code=body.code[keeps].copy(),
        arm=body.arm[keeps].copy(),
        apart=None,
    )
    rows = tuple(body.first_point + before[own - body.first_point] for own in ends)
    return bodies._replace(rigid=body), rows


def near_of(
    blocks: Blocks,
    layout: Layout,
    bodies: Bodies,
    masses: dict[str, np.ndarray],
    meetings: Meetings,
    bonded: np.ndarray,
    drives: Dofs,
    moved: Sequence[Dofs],
) -> tuple[Near, Members | None]:
    """Pieces that may meet, with room for the contacts of the undeformed shape twice over; and the kinds of blocks.

    masses (rows, dofs) of each kind, those of motion, of held blocks too; bonded (K, 2) blocks that bonds hold together
    """
    tets = outer_tets(layout)
    pieces = pieces_of(blocks, tets, None if layout.mesh is None else layout.mesh.nodes)
    most, room = most_points(pieces) * meetings.rounds, 8 * len(pieces.body) + 64
    search = search_of(blocks, layout, bodies, masses, meetings, bonded, pieces, tets, room)
    search.moves[bodies_with(layout, drives, tets)] = True
    search.moves[apart_on_ground(layout, moved, search.free, tets)] = True
    crushed = crushed_faces(pieces, sizes_of(layout, tets)[: blocks.count]) if meetings.crushes else None
    motion, members = motion_of(layout, bodies, pieces.reach, tets)
    return Near(
        pieces=pieces,
        turned=turned_of(pieces),
        cells=cells_for(pieces, room),
        pairs=no_pairs(room),
        before=no_pairs(room),
        points=no_points(room, most, meetings.branches, ROWS if meetings.crushes else 0),
        rules=own_rules(meetings),
        motion=motion,
        search=search,
        footprint=no_footprint(most),
        former=no_former_patch(most),
        scratch=scratch_of(pieces),
        account=np.zeros(6),
        crushed=crushed,
    ), members


def search_of(
    blocks: Blocks,
    layout: Layout,
    bodies: Bodies,
    masses: dict[str, np.ndarray],
    meetings: Meetings,
    bonded: np.ndarray,
    pieces: ConvexPieces,
    tets: SurfaceTets | None,
    room: int,
) -> Search:
    """Data of the search for contacts among these pieces, with room for so many pairs."""
    count, size, pair_keys = len(pieces.block), sizes_of(layout, tets), keys(bonded, len(pieces.body))
    free = free_bodies(layout, bodies, tets)
    return Search(
        group=blocks.group.astype(np.int64)[pieces.block],
        unit=blocks.unit.astype(np.int64)[pieces.block],
        law_of=meetings.law_of,
        bonded=pair_keys,
        alive=np.ones(len(pair_keys), dtype=bool),
        free=free,
        moves=free.copy(),
        mass=masses_of(layout, masses, pieces.block) if tets is None else masses_behind(layout, masses)[pieces.block],
        meshed=tets is not None,
        minimum_area=LEAST * size**2,
        deep=np.sqrt(LEAST * size[pieces.block] ** 2),
        position=np.zeros((count, 3)),
        built=np.full(count, -1e30),
        skin=np.array([meetings.skin * size[: blocks.count].mean()]),
        spread=meetings.spread,
        rounds=rounds_of(meetings.along),
        candidates=np.zeros((room, 2), dtype=np.int64),
        losers=np.zeros(room, dtype=np.int64),
        listed=np.zeros(1, dtype=bool),
        first_pair=np.zeros(count, dtype=np.int64),
        next_pair=np.zeros((room, 2), dtype=np.int64),
        patches=np.zeros(len(pieces.normal), dtype=np.int64),
        stale=np.zeros(len(pieces.normal), dtype=bool),
        stale_block=np.zeros(count, dtype=bool),
        refusal=np.zeros(3, dtype=np.int64),
        tally=np.zeros(2, dtype=np.int64),
    )


def own_rules(meetings: Meetings) -> Rules:
    """The rules of a model: with branches that bear nothing yet, and what restitution needs, which its steps change."""
    rules, count = meetings.rules, meetings.branches
    if count:
        rules = rules._replace(keep=np.zeros(count), gain=np.zeros(count))
    return rules if rules.rise is None else rules._replace(rise=rules.rise.copy())


def keys(pairs: np.ndarray, count: int) -> np.ndarray:
    """Pairs (K, 2) of blocks as sorted numbers."""
    return np.unique(pairs.min(axis=1) * count + pairs.max(axis=1)).astype(np.int64)


def bonds_of(
    sides: np.ndarray,
    joints: Joints,
    centroid: np.ndarray,
    frames: np.ndarray,
    u: np.ndarray,
    apart: np.ndarray,
    alive: np.ndarray,
) -> Bonds:
    """Frames and displacements of the contacts; sides (C, 2) rows of u; frames (B, 3, 3) and centroid (B, 3) m of all
    blocks; alive (C,) whether they have strength."""
    pair = np.column_stack([joints.block_a, joints.block_b])
    changes = np.flatnonzero(np.any(np.diff(np.column_stack([pair, alive]).astype(np.int64), axis=0), axis=1)) + 1
    first = np.concatenate([[0], changes])[: len(alive)].astype(np.int64)
    behind = np.append(first[1:], len(alive))[: len(first)]
    hold = alive[first]
    runs = np.column_stack([pair[first], first, behind]).astype(np.int64)
    lever = (joints.point[first, None] - centroid[pair[first]]).reshape(-1, 6)
    return Bonds(
        frames=frames,
        alive=alive,
        runs=np.ascontiguousarray(runs[hold]),
        lever=np.ascontiguousarray(lever[hold]),
        across=in_rows(joints.point - np.repeat(joints.point[first], behind - first, axis=0)),
        rows=np.array(sides),
        u=u,
        force=in_rows(np.zeros(apart.shape)),
        apart=apart,
    )
