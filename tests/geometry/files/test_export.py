import numpy as np
import pytest

from geometry.blocks import GeometryError, Specimen
from geometry.files.export import block_names, export
from geometry.files.mesh_files import read_mesh
from geometry.files.step_writer import quoted
from geometry.meshes.gmsh_session import gmsh_model
from geometry.polyhedra.construct import concatenate, from_faces
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.validate import require_sound_mesh
from geometry.specimens.boxes import boxes
from geometry.specimens.wallette import wallette

WALL = {
    "courses": 3,
    "units_per_course": 2,
    "unit_length": 0.24,
    "unit_height": 0.113,
    "thickness": 0.0115,
    "joint_thickness": 0.01,
    "plates": 0.05,
}


@pytest.fixture
def wall(rotate):
    specimen = wallette(**WALL)
    blocks, _ = rotate(specimen.blocks, 31.0)
    return Specimen(blocks, specimen.sets)


@pytest.fixture
def notched(prism):
    """An L and a box in its notch; the faces of the L in one plane meet in a corner of neither."""
    bottom = [np.array([[0, 0], [2, 0], [2, 1], [0, 1.0]]), np.array([[0, 1], [1, 1], [1, 3], [0, 3.0]])]
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 3], [0, 3.0]])
    sides = prism(outline, 0.0, 0.5)[2:]
    flat = [np.column_stack([part[::-1], np.zeros(4)]) for part in bottom]
    flat += [np.column_stack([part, np.full(4, 0.5)]) for part in bottom]
    return Specimen(
        concatenate(
            [
                from_faces([flat + sides], [0], [0], ["units"]),
                from_faces([prism(np.array([[1, 1], [2, 1], [2, 3], [1, 3.0]]), 0.0, 0.5)], [1], [0], ["units"]),
            ]
        )
    )


def solids(path):
    """Volume (m3), name and centre of every solid as a CAD kernel reads them, in the order of the file."""
    with gmsh_model({}) as gmsh:
        gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        gmsh.model.occ.importShapes(str(path))
        gmsh.model.occ.synchronize()
        tags = [tag for _, tag in gmsh.model.getEntities(3)]
        volume = np.array([gmsh.model.occ.getMass(3, tag) for tag in tags]) * 1e-9
        name = [gmsh.model.getEntityName(3, tag).split("/")[-1] for tag in tags]
        box = np.array([gmsh.model.getBoundingBox(3, tag) for tag in tags]) * 1e-3
    return volume, name, box


def test_a_cad_kernel_reads_every_block_with_its_name_volume_and_place(wall, tmp_path):
    export(tmp_path / "wall.step", wall)
    volume, name, box = solids(tmp_path / "wall.step")
    assert volume == pytest.approx(volumes(wall.blocks), rel=1e-12)
    assert name == block_names(wall)
    low, high = bounds(wall.blocks)
    assert np.allclose(box, np.column_stack([low, high]), atol=1e-6)


def test_a_block_that_is_not_convex_becomes_one_solid(notched, tmp_path):
    export(tmp_path / "l.step", notched)
    assert solids(tmp_path / "l.step")[0] == pytest.approx([2.0, 1.0], rel=1e-12)


@pytest.mark.parametrize("suffix", [".msh", ".vtu"])
def test_volumes_come_back_from_meshes(wall, notched, tmp_path, suffix):
    for specimen in (wall, notched):
        export(tmp_path / f"a{suffix}", specimen)
        imported = read_mesh(tmp_path / f"a{suffix}")
        require_sound_mesh(imported.blocks, imported.mesh)
        assert volumes(imported.blocks) == pytest.approx(volumes(specimen.blocks), rel=1e-11)
        assert np.array_equal(imported.blocks.group, specimen.blocks.group)
        if suffix == ".msh":
            assert imported.blocks.groups == specimen.blocks.groups


def test_blocks_are_called_by_the_sets_that_hold_them_alone():
    box = [("a", (0, 0, 0), (1, 1, 1), "units", 0, (2, 1, 1)), ("b's", (0, 0, 1), (2, 1, 1), "mortar", 1, (1, 1, 1))]
    specimen = boxes(box, 1.0)
    assert block_names(specimen) == ["units-0-1", "units-0-2", "b's"]


def test_names_with_quotes_and_other_alphabets_are_coded(tmp_path):
    assert quoted("b's \\ é") == "'b''s \\\\ \\X2\\00E9\\X0\\'"
    specimen = boxes([("pier 'A' n° 1", (0, 0, 0), (1, 1, 1), "units", 0, (1, 1, 1))], 1.0)
    export(tmp_path / "a.stp", specimen)
    assert solids(tmp_path / "a.stp")[1] == ["pier 'A' n° 1"]


def test_the_same_specimen_gives_the_same_file(wall, tmp_path):
    for name in ("one", "two"):
        export(tmp_path / f"{name}.step", wall)
    assert (tmp_path / "one.step").read_bytes() == (tmp_path / "two.step").read_bytes()


def test_an_unknown_suffix_is_refused_and_nothing_is_written(wall, tmp_path):
    with pytest.raises(GeometryError, match="not as '.dxf'"):
        export(tmp_path / "a.dxf", wall)
    with pytest.raises(GeometryError, match="cannot write"):
        export(tmp_path / "none" / "a.step", wall)
    assert list(tmp_path.iterdir()) == []


def test_slivers_of_faces_do_not_hinder_the_export_and_cost_no_volume(tmp_path, prism):
    thin = prism(np.array([[0, 0], [1, 0], [1, 1], [1 - 1e-9, 1], [0, 1.0]]), 0.0, 1.0)
    specimen = Specimen(from_faces([thin], [0], [0], ["units"]))
    export(tmp_path / "a.msh", specimen)
    assert volumes(read_mesh(tmp_path / "a.msh").blocks) == pytest.approx([1.0], rel=1e-9)
