"""Blocks of any convex shape divided as units are: into a regular grid, or into cells."""

from dataclasses import replace

import numpy as np

from geometry.blocks import Blocks, CellReport, GeometryError, Specimen
from geometry.cells.domain import Domain
from geometry.cells.request import CellRequest
from geometry.cells.targets import given_sites, share_out
from geometry.checks import require_counts
from geometry.polyhedra.construct import concatenate, from_faces, selected
from geometry.polyhedra.intersect import are_convex
from geometry.polyhedra.measures import bounds, extent, face_areas_normals_centroids, volumes
from geometry.specimens.filling import plane_cells, space_cells
from geometry.specimens.plane_cuts import in_grid
from geometry.specimens.stacked import Filling

SAME = 1e-9
"""Of the specimen's longest side, and of a unit vector: faces of a block that are nearer lie in one plane."""


def divided(specimen: Specimen, filling: Filling, group: str = "units") -> Specimen:
    """The specimen with all blocks of a group divided: (nx, ny, nz) parts of each, or cells in all of them together.

    A part keeps the unit of its block and is in all sets that its block was in. Raises GeometryError where blocks are
    not convex, where plane cells are asked of blocks that are no prisms along y, and where there are no such blocks.
    """
    blocks = specimen.blocks
    if group not in blocks.groups:
        raise GeometryError(f"there are no blocks of group '{group}' to be divided, only of {', '.join(blocks.groups)}")
    mine = blocks.group == blocks.groups.index(group)
    chosen, others = np.flatnonzero(mine), np.flatnonzero(~mine)
    if not (convex := are_convex(blocks, SAME * extent(blocks)))[chosen].all():
        b = int(chosen[np.argmin(convex[chosen])])
        raise GeometryError(f"block {b} is not convex; only convex blocks can be divided: make its parts blocks each")
    if isinstance(filling, CellRequest) and not filling.space:
        _require_prisms(blocks, chosen)
    one = selected(blocks, chosen)
    reports: tuple[CellReport, ...] = ()
    if isinstance(filling, CellRequest):
        parts, report = _cells(one, filling, group)
        reports = (report,)
    else:
        require_counts("file", "divisions", filling, "xyz")
        pieces = [in_grid([one.face(f) for f in one.faces_of(b)], filling) for b in range(one.count)]
        owner = np.repeat(np.arange(one.count), [len(faces) for faces in pieces])
        parts = from_faces([p for faces in pieces for p in faces], owner.tolist(), [0] * len(owner), (group,))
    parent = np.concatenate([others, chosen[parts.unit]])
    whole = replace(parts, unit=one.unit[parts.unit])
    if len(others):
        whole = concatenate([selected(blocks, others), whole])
    sets = {name: np.flatnonzero(np.isin(parent, members)) for name, members in specimen.sets.items()}
    return replace(specimen, blocks=whole, sets=sets, cells=(*specimen.cells, *reports))


def _cells(blocks: Blocks, request: CellRequest, group: str) -> tuple[Blocks, CellReport]:
    """Cells of all blocks together; the unit of a cell is the number of its block."""
    rng = np.random.default_rng(request.seed)
    domains, volume = [_domain(blocks, b) for b in range(blocks.count)], volumes(blocks)
    low, high = (corner[:, 1] for corner in bounds(blocks))
    if request.sites is not None:
        places = np.asarray(request.sites, dtype=float).reshape(-1, 3)
        site, counts = given_sites(request, np.stack([domain.contains(places) for domain in domains], axis=1))
    else:
        site, counts = None, share_out(request, volume, high - low)
    if request.space:
        return space_cells(domains, volume, request, group, counts, site, rng)
    fronts = face_areas_normals_centroids(blocks)[1][:, 1] < -1 + SAME
    outlines = [blocks.face(f)[:, [0, 2]] for f in np.flatnonzero(fronts).tolist()]
    return plane_cells(outlines, low, high, volume / (high - low), request, group, counts, site, rng)


def _domain(blocks: Blocks, block: int) -> Domain:
    """A block as half-spaces, one for all faces in a plane."""
    one = selected(blocks, np.array([block]))
    _, normal, centroid = face_areas_normals_centroids(one)
    offset, near = np.einsum("fi,fi->f", normal, centroid), SAME * extent(blocks)
    planes: list[int] = []
    for f in range(len(offset)):
        if not any(normal[f] @ normal[k] > 1 - SAME and abs(offset[f] - offset[k]) <= near for k in planes):
            planes.append(f)
    return Domain(normal[planes], offset[planes])


def _require_prisms(blocks: Blocks, which: np.ndarray) -> None:
    """Each of these blocks has one face across y in front, one behind, and all others along y."""
    across = face_areas_normals_centroids(blocks)[1][:, 1]
    for b in which.tolist():
        mine = across[blocks.block_face_start[b] : blocks.block_face_start[b + 1]]
        ends = [int(np.sum(side > 1 - SAME)) for side in (-mine, mine)]
        if ends != [1, 1] or int(np.sum(np.abs(mine) <= SAME)) != len(mine) - 2:
            raise GeometryError(
                f"block {b} is no prism along y, which plane cells need; cells of form = 'space' do not"
            )
