"""Cells of units and mortar beds: what a request gave, what it cost, and how well tets fit into them."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from geometry.blocks import CellReport
from geometry.cells.domain import box_domain
from geometry.cells.power import tessellate
from geometry.cells.power_blocks import cell_volumes, to_blocks
from geometry.cells.request import CellRequest
from geometry.joints.find import find_joints
from geometry.joints.quality import radius_ratios
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.specimens.bond import lay
from geometry.specimens.filling import fill_with_cells
from masonry import scene
from verification.html import page

ORDER = 45
SEEDS = 3
MESH_SIZE, ROUND = 0.55, 0.15
"""Edge of the tets in h, and the least radius ratio that is sought."""


@dataclass(frozen=True)
class DividedBox:
    """Boxes to divide and what is sought: shortest over mean edge, share of small edges, size error, joint segment."""

    name: str
    low: np.ndarray
    high: np.ndarray
    request: CellRequest
    neper: str
    edge: float = 0.35
    small: float = 0.0
    size: float = 0.01
    joint: float = 0.2
    meshed: bool = False


def cases() -> list[DividedBox]:
    """The wallette of the paper's Fig. 9, the mortar bed of its couplet, and a brick in all three dimensions."""
    wall = scene.load("wallette-mode-1").specimen
    assert wall.kind == "wallette"
    unit = wall.unit_length, wall.unit_height
    bond = lay(wall.bond, wall.courses, wall.units_per_course, unit, wall.joint_thickness, wall.thickness)
    bed = np.array([[0.0, 0.0, 0.05]]), np.array([[0.2, 0.005, 0.065]])
    brick = np.zeros((1, 3)), np.array([[0.23, 0.114, 0.065]])
    plane = [
        DividedBox(f"wallette, {n}", bond.low, bond.high, CellRequest(total=n), "0.15 to 0.34; some", meshed=n != 335)
        for n in (218, 335, 540)
    ]
    mortar = [DividedBox(f"mortar bed 200 x 15 mm, {n}", *bed, CellRequest(total=n), "-") for n in (100, 300)]
    many = CellRequest(total=540, space=True)
    space = [
        DividedBox("brick in space, 218", *brick, CellRequest(total=218, space=True), "0.09 to 0.2; 5 %", meshed=True),
        DividedBox("brick in space, 540", *brick, many, "0.04 to 0.07; 4 to 5 %", edge=0.3, small=0.05, size=0.02),
    ]
    return plane + mortar + space


def chapter(tell: Callable[[str], None], quick: bool = False) -> page.Chapter:
    """Tables of cells and of tets; a verdict on each."""
    made = page.Chapter("Cells")
    rows, tets = [], []
    met: list[bool] = []
    ratios: list[float] = []
    for case in cases():
        tell(f"cells: {case.name}")
        reports = [_divided(case, seed)[1] for seed in range(1 if quick else SEEDS)]
        rows.append(_row(case, reports, met))
        made.records += [{"case": case.name, "seed": k, **vars(r)} for k, r in enumerate(reports)]
        if case.meshed:
            tets.append(_meshed(case, ratios))
    many = 5_000 if quick else 50_000
    tell(f"cells: {many:,} tessellated")
    header = ["cells", "shortest / mean edge", "small edges", "size error", "shortest joint piece", "seconds", "Neper"]
    made.add(
        INTRODUCTION,
        page.table(header, rows, "Cells: worst of all seeds"),
        page.table(["cells", "tets", "ms a block", "worst radius ratio"], tets, "Tets of 0.55 h by gmsh"),
        _many(many),
    )
    minimum = min(ratios)
    made.judge("Cells", all(met), f"{sum(met)} of {len(met)} limits are kept.")
    made.judge("Tets in cells", minimum >= ROUND, f"Least radius ratio {minimum:.2f}; {ROUND:g} is sought.")
    return made


INTRODUCTION = (
    "Units and beds are divided into power diagrams, whose cells are convex with planar faces. Lengths are in h, the "
    "root of the mean area of a cell or the cube root of its mean volume. An edge is small below 0.125 h in a plane "
    f"and 0.25 h in space. Worst of {SEEDS} seeds; the seconds are those of a shared machine. Neper's figures are of "
    "version 4.10."
)


def _divided(case: DividedBox, seed: int):
    request = CellRequest(total=case.request.total, space=case.request.space, seed=seed)
    return fill_with_cells(case.low, case.high, request, "units")


def _row(case: DividedBox, reports: list[CellReport], met: list[bool]) -> list[page.TableCell | str]:
    edge, small = min(r.shortest_over_mean for r in reports), max(r.small_edges for r in reports)
    size, joints = max(r.size_error for r in reports), [r.shortest_joint for r in reports if r.shortest_joint]
    limits = [
        (f"{edge:.2f}", edge >= case.edge, f"{case.edge:g}"),
        (page.percent(small), small <= case.small, page.percent(case.small)),
        (f"{size:.0e}", size <= case.size, f"{case.size:g}"),
    ]
    limits += [(f"{min(joints):.2f} h", min(joints) >= case.joint, f"{case.joint:g} h")] if joints else []
    met += [good for _, good, _ in limits]
    cells = [page.judged(text, good, f"sought {sought}") for text, good, sought in limits]
    cells += [] if joints else [page.TableCell("-")]
    return [case.name, *cells, f"{max(r.seconds for r in reports):.2g}", case.neper]


def _meshed(case: DividedBox, ratios: list[float]) -> list[page.TableCell | str | int]:
    blocks, report = _divided(case, 0)
    joints = find_joints(blocks)
    begin = time.perf_counter()
    mesh, _ = mesh_blocks(blocks, np.ones(blocks.count, dtype=bool), MESH_SIZE * report.h, joints)
    each = 1e3 * (time.perf_counter() - begin) / blocks.count
    worst = float(radius_ratios(mesh).min())
    ratios.append(worst)
    ratio = page.judged(f"{worst:.3f}", worst >= ROUND, f"sought {ROUND:g}")
    return [case.name, len(mesh.tets), f"{each:.1f}", ratio]


def _many(count: int) -> str:
    """A sentence on a tessellation of many cells."""
    sites = np.random.default_rng(0).uniform(0.0, 1.0, (count, 3))
    begin = time.perf_counter()
    power = tessellate(sites, np.zeros(count), box_domain(np.zeros(3), np.ones(3)))
    blocks = to_blocks(power, np.zeros(count, dtype=np.int64))
    seconds = time.perf_counter() - begin
    faces = np.diff(blocks.block_face_start)
    error = abs(cell_volumes(power).sum() - 1.0)
    return (
        f"{count} cells of a Voronoi division in space, as blocks: {seconds:.1f} s; {faces.mean():.2f} faces a cell; "
        f"volumes add up to the whole within {error:.0e}."
    )
