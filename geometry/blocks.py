"""The contract of the geometry floor: polyhedral blocks, their tets, and the joints between them, as plain arrays.

Axes: x along the length of the specimen, y through its thickness, z up. All lengths in metres.
"""

from dataclasses import dataclass, field

import numpy as np

from geometry.errors import GeometryError as GeometryError


@dataclass(frozen=True)
class Blocks:
    """Polyhedra with planar convex faces.

    A block that is not convex, such as a perforated unit, has several convex faces in one plane where it needs them.

    points            (P, 3) m, corners; blocks may or may not share them
    face_start        (F + 1,) where the corners of face f begin in face_points
    face_points       indices into points, counter-clockwise seen from outside the block
    block_face_start  (B + 1,) the faces of block b are contiguous
    unit              (B,) number of the unit, mortar bed or plate that block b is part of
    group             (B,) index into groups
    groups            names such as "units", "mortar", "plates"
    """

    points: np.ndarray
    face_start: np.ndarray
    face_points: np.ndarray
    block_face_start: np.ndarray
    unit: np.ndarray
    group: np.ndarray
    groups: tuple[str, ...]

    @property
    def count(self) -> int:
        return len(self.unit)

    def face(self, f: int) -> np.ndarray:
        """(n, 3) corners of face f, counter-clockwise seen from outside."""
        return self.points[self.face_points[self.face_start[f] : self.face_start[f + 1]]]

    def faces_of(self, b: int) -> range:
        return range(self.block_face_start[b], self.block_face_start[b + 1])

    def face_block(self) -> np.ndarray:
        """(F,) the block that owns each face."""
        return np.repeat(np.arange(self.count), np.diff(self.block_face_start))


@dataclass(frozen=True)
class TetMesh:
    """Constant-strain tets inside some of the blocks; blocks without any have empty ranges.

    nodes       (N, 3) m, numbered block by block; a node on a joint exists once in each meshed block
    node_start  (B + 1,)
    tets        (T, 4) node numbers, positive volume, in the order of blocks
    tet_start   (B + 1,)
    """

    nodes: np.ndarray
    node_start: np.ndarray
    tets: np.ndarray
    tet_start: np.ndarray


@dataclass(frozen=True)
class Joints:
    """Contact points between blocks.

    block_a, block_b  (C,) with block_a < block_b
    node_a, node_b    (C,) tet node that sits at the point, or -1 where that side has none there
    point             (C, 3) m
    normal            (C, 3) unit vector from a to b
    area              (C,) m2; the areas of one joint face add up to the area of its overlap polygon
    patch             (C,) the overlap polygon that the point belongs to
    patch_start       (J + 1,) corners of polygon j in patch_points
    patch_points      (., 3) m
    corner_a, corner_b  (C, 3) tet nodes of the surface triangle that the point lies in, -1 on a side that has a node at
                      the point or no tets; None where no point of the specimen needs them
    share_a, share_b  (C, 3) shape functions of these nodes at the point, adding up to 1; 0 where there are none
    dropped           joint faces dropped because their area is zero within the tolerance
    repeated          joint faces dropped because the two blocks have the same one already
    """

    block_a: np.ndarray
    block_b: np.ndarray
    node_a: np.ndarray
    node_b: np.ndarray
    point: np.ndarray
    normal: np.ndarray
    area: np.ndarray
    patch: np.ndarray
    patch_start: np.ndarray
    patch_points: np.ndarray
    dropped: int = 0
    repeated: int = 0
    corner_a: np.ndarray | None = None
    share_a: np.ndarray | None = None
    corner_b: np.ndarray | None = None
    share_b: np.ndarray | None = None


@dataclass(frozen=True)
class JointPolygons:
    """Joints that are stated, not found: polygons between blocks that only nearly meet.

    block_a, block_b  (J,) with block_a < block_b
    start             (J + 1,) where the corners of polygon j begin in points
    points            (., 3) m, counter-clockwise about the normal from a to b
    gap               (J, 2) m, least and greatest distance of the two blocks there; below 0 they overlap
    """

    block_a: np.ndarray
    block_b: np.ndarray
    start: np.ndarray
    points: np.ndarray
    gap: np.ndarray


@dataclass(frozen=True)
class CellReport:
    """Quality of a division. Lengths are relative to h: the root of the mean area, or cube root of the mean volume.

    count               cells
    h                   m
    shortest_over_mean  shortest edge over the mean edge
    shortest            shortest edge / h
    small_edges         share of the edges below 0.125 h (plane) or 0.25 h (space)
    size_error          largest deviation of a cell's size from its target, relative to the target
    shortest_joint      shortest segment of a joint between cells of neighbouring units / h; None where there is none
    seconds             time taken
    """

    count: int
    h: float
    shortest_over_mean: float
    shortest: float
    small_edges: float
    size_error: float
    shortest_joint: float | None
    seconds: float


@dataclass(frozen=True)
class Specimen:
    """Blocks with names: what a scene's supports, drives and tractions refer to.

    sets     name -> block numbers ("top", "bottom", "left plate", ...)
    section  m2, the area that turns a force into the reported stress
    shape    one word for the report ("couplet", "wallette", "boxes")
    cells    what came of each division into cells
    joints   joints that are stated, in place of those that are found; None where all are found
    overlap  m, by how much blocks may overlap: what an import left within its tolerance
    """

    blocks: Blocks
    sets: dict[str, np.ndarray] = field(default_factory=dict)
    section: float = 1.0
    shape: str = "boxes"
    cells: tuple[CellReport, ...] = ()
    joints: JointPolygons | None = None
    overlap: float = 0.0


@dataclass(frozen=True)
class Imported:
    """Solids read from a file, in metres.

    blocks   one a solid; groups are those of the file, or "units" where it has none
    names    one a block, "" where the file has none
    colours  (B, 3) red, green, blue in 0..1, NaN rows where the file has none; None if it has none at all
    mesh     tets, if the file holds any
    notes    sentences for the user: what was cut up, left out or changed
    """

    blocks: Blocks
    names: tuple[str, ...]
    colours: np.ndarray | None
    mesh: TetMesh | None = None
    notes: tuple[str, ...] = ()
