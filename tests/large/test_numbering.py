"""The numbers that a file gives to blocks and points change no bit of what they do."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from geometry.blocks import Blocks, Specimen, TetMesh
from geometry.files.blocks_h5 import save_blocks
from geometry.joints.find import find_joints
from geometry.meshes.fan import mesh_by_fans
from geometry.meshes.fan_tets import gathered
from geometry.polyhedra.construct import selected
from geometry.polyhedra.measures import bounds
from geometry.specimens.numbered import by_place, numbered_by_place
from masonry.laboratory import laboratory
from tests.detection.touching import cells
from tests.scenes import MATERIAL, listed, load, tables

COUNT, SIZE = 12, 0.2


def rubble() -> Specimen:
    """Cells of a cube: those that stand on the ground, and the others."""
    blocks = cells(COUNT, 3)
    blocks = replace(blocks, points=SIZE * blocks.points, groups=("units",))
    stands = bounds(blocks)[0][:, 2] < 1e-9
    sets = {"foot": np.flatnonzero(stands), "rest": np.flatnonzero(~stands)}
    return Specimen(blocks, sets, SIZE**2, "cells")


def shuffled(specimen: Specimen, seed: int) -> Specimen:
    """With other numbers of blocks and of points."""
    rng, blocks = np.random.default_rng(seed), specimen.blocks
    order, place = rng.permutation(blocks.count), rng.permutation(len(blocks.points))
    blocks = replace(blocks, points=blocks.points[place], face_points=np.argsort(place)[blocks.face_points])
    number = np.argsort(order)
    sets = {name: rng.permutation(number[own]) for name, own in specimen.sets.items()}
    return replace(specimen, blocks=selected(blocks, order), sets=sets)


def fans(blocks: Blocks) -> TetMesh:
    return mesh_by_fans(blocks, np.ones(blocks.count, dtype=bool), find_joints(blocks))[0]


def shuffled_mesh(mesh: TetMesh, seed: int) -> TetMesh:
    """The mesh of the blocks that `shuffled` gives, with other numbers of nodes, and of tets and their corners."""
    rng, count = np.random.default_rng(seed), len(mesh.node_start) - 1
    order, tets = rng.permutation(count), mesh.tets.copy()
    nodes = mesh.nodes.copy()
    for first, last in pairwise(mesh.node_start.tolist()):
        place = first + rng.permutation(last - first)
        nodes[first:last] = mesh.nodes[place]
        own = (mesh.tets >= first) & (mesh.tets < last)
        tets[own] = first + np.argsort(place)[mesh.tets[own] - first]
    for first, last in pairwise(mesh.tet_start.tolist()):
        tets[first:last] = tets[first + rng.permutation(last - first)][:, [2, 0, 1, 3]]
    return gathered(count, {b: (replace(mesh, nodes=nodes, tets=tets), int(old)) for b, old in enumerate(order)})


def rows_of(path: Path, specimen: Specimen, kind: str, mesh: TetMesh | None, contact: str) -> dict[str, np.ndarray]:
    """Cells that are thrown off those of the foot, which are held."""
    save_blocks(path, specimen, mesh)
    result = laboratory.run(
        load(
            f'displacements = "large"\nlaw = "brittle"\nkinematics = "{kind}"\n'
            f'[specimen]\nkind = "file"\npath = "{path}"\n'
            + tables("material", {"units": MATERIAL})
            + tables("contact", {"default": contact})
            + listed("support", ['on = "foot"\nfix = "all"'])
            + listed("motion", ['on = "rest"\nvelocity = ["2 m/s", "0.3 m/s", "0.1 m/s"]'])
            + f'[solver]\nmasses = "real"\ndamping = 0\nduration = "{20 if mesh is None else 4} ms"\nrows = 20\n'
        )
    )
    return result.history.rows


DRY = 'law = "friction"\nnormal_stiffness = "10 GPa/m"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = 0.6'
GLUED = DRY.replace("friction", "brittle", 1) + '\ntensile_strength = "0.1 MPa"\ncohesion = "0.2 MPa"'


def test_blocks_in_order_are_the_same_blocks():
    specimen = rubble()
    one, other = numbered_by_place(specimen), numbered_by_place(shuffled(specimen, 1))
    for name in ("points", "face_start", "face_points", "block_face_start", "unit", "group"):
        assert np.array_equal(getattr(one.blocks, name), getattr(other.blocks, name)), name
    assert np.array_equal(one.sets["foot"], other.sets["foot"])
    assert np.array_equal(by_place(one.blocks), np.arange(COUNT))
    assert np.array_equal(one.blocks.unit, by_place(specimen.blocks)), "units keep the numbers that they had"


@pytest.mark.parametrize(
    ("kind", "meshed", "contact"),
    [
        pytest.param("rigid", False, DRY, id="cells"),
        pytest.param("rigid", False, GLUED, id="glued cells that break apart", marks=pytest.mark.slow),
        pytest.param("affine", False, GLUED, id="glued cells that deform", marks=pytest.mark.slow),
        pytest.param("tets", True, DRY, id="cells with meshes of the file", marks=pytest.mark.slow),
    ],
)
def test_a_file_whose_blocks_are_shuffled_gives_the_same_bits(tmp_path, kind, meshed, contact):
    mesh = fans(rubble().blocks) if meshed else None
    one = rows_of(tmp_path / "one.blocks.h5", rubble(), kind, mesh, contact)
    mesh = mesh and shuffled_mesh(mesh, 2)
    other = rows_of(tmp_path / "other.blocks.h5", shuffled(rubble(), 2), kind, mesh, contact)
    assert one["friction"][-1] > 0.0
    for key, values in one.items():
        assert values.tobytes() == other[key].tobytes(), key
