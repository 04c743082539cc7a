"""How blocks stand and move, for what they meet: the arrays of rigid bodies themselves, or gathered from all kinds."""

from collections.abc import Sequence

import numpy as np

from masonry.detection.tet_pieces import SurfaceTets, surface_tets
from masonry.kernels.gathering import Members
from masonry.model.body_arrays import Bodies, whole_rows
from masonry.model.element_plan import Dofs
from masonry.model.kinds import KIND
from masonry.model.layout import KINDS, Layout, tet_gradients
from masonry.patches.arrays import BlockMotion


def outer_tets(layout: Layout) -> SurfaceTets | None:
    """The tets at the surface of meshed blocks, each a body of its own behind those of the blocks; None without any."""
    return None if layout.mesh is None else surface_tets(layout.mesh, tet_gradients(layout.mesh))


def motion_of(
    layout: Layout, bodies: Bodies, reach: np.ndarray, tets: SurfaceTets | None
) -> tuple[BlockMotion, Members | None]:
    """Motion of all bodies, and which block is of which kind where some deform; reach (N,) m, see Members."""
    rigid, centre = bodies.rigid, layout.centroid.copy()
    if not layout.deforms.any():
        rows = (whole_rows(rigid.q), rigid.frame, whole_rows(rigid.v), whole_rows(rigid.patches))
        return BlockMotion(centre, *rows, reach.copy(), np.zeros(len(reach))), None
    none = np.zeros((0, 4), dtype=np.int64), np.zeros((0, 4, 3)), np.zeros((0, 3))
    node, slope, own = none if tets is None else (tets.node.astype(np.int64), tets.slope, tets.centre)
    count = len(reach)
    straight = [np.tile(np.eye(3), (count, 1, 1)) for _ in range(2)]
    motion = BlockMotion(
        centre=np.concatenate([centre, own]),
        moved=np.zeros((count, 3)),
        frame=straight[0],
        v=np.zeros((count, 6)),
        push=np.zeros((count, 12)),
        radius=reach.copy(),
        travel=np.zeros(count),
        dual=straight[1],
        rate=np.zeros((count, 3, 3)),
        strain=np.zeros(count),
    )
    which = layout.members
    return motion, Members(which["rigid"], which["affine"], which["tets"], reach.copy(), node, slope)


def masses_of(layout: Layout, masses: dict[str, np.ndarray], block: np.ndarray) -> np.ndarray:
    """(N,) kg of motion of the blocks that bodies are or belong to, from those of the dofs of each kind."""
    mass = np.zeros(len(layout.kind))
    for kind in ("rigid", "affine"):
        mass[layout.members[kind]] = masses[kind][:, 0]
    if layout.mesh is not None:
        own = np.repeat(np.arange(len(layout.kind)), np.diff(layout.mesh.node_start))
        mass += np.bincount(own, masses["tets"][:, 0], minlength=len(mass))
    return np.asarray(mass[block])


def masses_behind(layout: Layout, masses: dict[str, np.ndarray]) -> np.ndarray:
    """(B,) kg/m2 of all blocks, over a face of a cube of their volume: as much of a mass as a face has behind it."""
    return masses_of(layout, masses, np.arange(len(layout.kind))) / np.cbrt(layout.volume) ** 2


def free_bodies(layout: Layout, bodies: Bodies, tets: SurfaceTets | None) -> np.ndarray:
    """(N,) whether forces can move a body."""
    free = np.zeros(len(layout.kind), dtype=bool)
    for kind, body in zip(KINDS, bodies, strict=True):
        if body is not None and not KIND[kind].nodal:
            free[layout.members[kind]] = body.dt_over_mass.any(axis=1)
    if tets is None:
        return free
    return np.concatenate([free, bodies.tets.dt_over_mass.any(axis=1)[tets.node].any(axis=1)])


def bodies_with(layout: Layout, dofs: Dofs, tets: SurfaceTets | None) -> np.ndarray:
    """(N,) whether a body, or a node of it, has some of these dofs: of those that the drive moves, whether it does."""
    moved = np.zeros(len(layout.kind), dtype=bool)
    for kind, own in zip(KINDS, dofs, strict=True):
        if own is not None and not KIND[kind].nodal:
            moved[layout.members[kind][own[:, 0]]] = True
    if tets is None:
        return moved
    nodes = dofs[KINDS.index("tets")]
    return np.concatenate([moved, np.isin(tets.node, np.zeros(0) if nodes is None else nodes[:, 0]).any(axis=1)])


def apart_on_ground(layout: Layout, moved: Sequence[Dofs], free: np.ndarray, tets: SurfaceTets | None) -> np.ndarray:
    """(N,) whether the ground moves a body otherwise than another one that is held: by other motions, or that rests."""
    if not moved:
        return np.zeros(len(free), dtype=bool)
    moved_by = np.array([bodies_with(layout, dofs, tets) for dofs in moved])
    held = moved_by[:, ~free]
    return np.asarray((held != held[:, :1]).any() & moved_by.any(axis=0))


def sizes_of(layout: Layout, tets: SurfaceTets | None) -> np.ndarray:
    """(N,) m, edge of a cube of each body's volume."""
    own = np.cbrt(layout.volume)
    if tets is None:
        return own
    volume = 1.0 / (6.0 * np.abs(np.linalg.det(tets.slope[:, 1:])))
    return np.concatenate([own, np.cbrt(volume)])
