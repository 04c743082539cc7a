import base64
import subprocess
import sys
import zlib

import meshio
import numpy as np
import pytest

from geometry.blocks import GeometryError, Specimen
from geometry.files.export import export
from geometry.files.mesh_files import read_mesh
from geometry.joints.find import find_joints
from geometry.meshes.gmsh_session import gmsh_model
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.polyhedra.measures import face_areas_normals_centroids, volumes
from geometry.polyhedra.validate import require_sound, require_sound_mesh
from geometry.specimens.stacked import couplet

CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
SIX = np.array([[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]])


def tower(count):
    """Cubes on each other, neighbours with common nodes: points and tets."""
    points = np.concatenate([CUBE + [0, 0, k] for k in range(count)])
    points, number = np.unique(points, axis=0, return_inverse=True)
    return points, number.ravel()[np.concatenate([SIX + 8 * k for k in range(count)])]


@pytest.fixture
def write(tmp_path):
    def place(points, cells, suffix=".msh", cell_data=None, field_data=None, **keys):
        path = tmp_path / f"a{suffix}"
        mesh = meshio.Mesh(points, cells, cell_data=cell_data or {}, field_data=field_data or {})
        if suffix == ".msh":
            meshio.gmsh.write(path, mesh, **{"fmt_version": "2.2", **keys})
        else:
            meshio.vtu.write(path, mesh, **keys)
        return path

    return place


@pytest.fixture
def gmsh_file(tmp_path):
    """Two boxes of gmsh with a common face, as physical groups, and a box that stands apart."""

    def place(version, binary=False, physical=True):
        path = tmp_path / f"g{version}.msh"
        with gmsh_model({"Mesh.MeshSizeMax": 0.4, "Mesh.MshFileVersion": version, "Mesh.Binary": binary}) as gmsh:
            occ = gmsh.model.occ
            boxes = [
                (3, occ.addBox(0, 0, 0, 1, 1, 1)),
                (3, occ.addBox(0, 0, 1, 1, 1, 1)),
                (3, occ.addBox(3, 0, 0, 1, 1, 1)),
            ]
            occ.fragment(boxes[:1], boxes[1:])
            occ.synchronize()
            if physical:
                gmsh.model.addPhysicalGroup(3, [1, 3], name="old bricks")
                gmsh.model.addPhysicalGroup(3, [2], name="mortar")
            gmsh.model.mesh.generate(3)
            gmsh.write(str(path))
        return path

    return place


@pytest.mark.parametrize(("version", "binary"), [(2.2, False), (2.2, True), (4.1, False), (4.1, True)])
def test_volumes_of_a_gmsh_model_become_blocks_with_six_faces_each(gmsh_file, version, binary):
    imported = read_mesh(gmsh_file(version, binary), unit=0.1)
    blocks, mesh = imported.blocks, imported.mesh
    require_sound(blocks)
    require_sound_mesh(blocks, mesh)
    assert volumes(blocks) == pytest.approx(np.full(3, 1e-3), rel=1e-12)
    assert [len(blocks.faces_of(b)) for b in range(3)] == [6, 6, 6]
    assert sorted(np.array(blocks.groups)[blocks.group]) == ["mortar", "old bricks", "old bricks"]
    assert len(set(blocks.unit)) == 3
    assert find_joints(blocks).area.sum() == pytest.approx(0.01, rel=1e-12)


def test_nodes_on_a_shared_face_coincide_in_both_blocks(gmsh_file):
    imported = read_mesh(gmsh_file(4.1))
    nodes, start = imported.mesh.nodes, imported.mesh.node_start
    on_joint = [nodes[start[b] : start[b + 1]] for b in (0, 1)]
    level = [{tuple(p) for p in part[part[:, 2] == 1.0]} for part in on_joint]
    assert level[0] == level[1]
    assert len(level[0]) > 8


def test_without_groups_every_connected_part_is_a_block(write):
    points, tets = tower(2)
    path = write(np.concatenate([points, points + [5, 0, 0]]), [("tetra", np.concatenate([tets, tets + len(points)]))])
    blocks = read_mesh(path).blocks
    assert volumes(blocks) == pytest.approx([2, 2])
    assert blocks.groups == ("group0",) or blocks.groups == ("units",)


@pytest.mark.parametrize("name", ["group", "region", "material"])
def test_cell_data_of_a_vtu_file_part_the_tets(write, name):
    points, tets = tower(3)
    data = {name: [np.repeat([4, 7, 4], 6)]}
    blocks = read_mesh(write(points, [("tetra", tets)], ".vtu", data)).blocks
    assert volumes(blocks) == pytest.approx([1, 1, 1])
    assert np.array(blocks.groups)[blocks.group].tolist() == ["group4", "group7", "group4"]


def test_tets_turned_inside_out_are_turned(write):
    points, tets = tower(1)
    imported = read_mesh(write(points, [("tetra", tets[:, [1, 0, 2, 3]])]))
    require_sound_mesh(imported.blocks, imported.mesh)


def test_elements_of_the_second_order_give_the_tets_of_their_corners(gmsh_file, tmp_path):
    path = tmp_path / "second.msh"
    with gmsh_model({"Mesh.MeshSizeMax": 0.5, "Mesh.ElementOrder": 2}) as gmsh:
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(3)
        gmsh.write(str(path))
    imported = read_mesh(path)
    assert volumes(imported.blocks) == pytest.approx([1.0], rel=1e-12)
    assert "corners" in imported.notes[0]


def test_a_block_may_have_a_hole(tmp_path):
    with gmsh_model({"Mesh.MeshSizeMax": 0.3}) as gmsh:
        occ = gmsh.model.occ
        occ.cut([(3, occ.addBox(0, 0, 0, 1, 1, 1))], [(3, occ.addBox(0.3, 0.3, 0, 0.4, 0.4, 1))])
        occ.synchronize()
        gmsh.model.mesh.generate(3)
        gmsh.write(str(tmp_path / "hole.msh"))
    imported = read_mesh(tmp_path / "hole.msh")
    require_sound(imported.blocks)
    require_sound_mesh(imported.blocks, imported.mesh)
    assert volumes(imported.blocks) == pytest.approx([0.84], rel=1e-12)
    area = face_areas_normals_centroids(imported.blocks)[0]
    assert area.sum() == pytest.approx(4 + 2 * 0.84 + 1.6, rel=1e-12)


@pytest.mark.parametrize("suffix", [".msh", ".vtu"])
def test_an_exported_mesh_comes_back_as_it_was(tmp_path, suffix):
    specimen = couplet(0.2, 0.05, 0.05, (2, 1, 1), mortar=(0.01, (3, 1, 1)), plates=0.02)
    mesh, _ = mesh_blocks(specimen.blocks, specimen.blocks.group == 1, 0.02, find_joints(specimen.blocks))
    export(tmp_path / f"a{suffix}", specimen, mesh)
    imported = read_mesh(tmp_path / f"a{suffix}")
    assert volumes(imported.blocks) == pytest.approx(volumes(specimen.blocks), rel=1e-12)
    assert np.array_equal(imported.blocks.group, specimen.blocks.group)
    own = np.repeat(np.diff(mesh.tet_start) > 0, np.diff(imported.mesh.tet_start))
    assert np.array_equal(imported.mesh.nodes[imported.mesh.tets[own]].mean(axis=1), mesh.nodes[mesh.tets].mean(axis=1))


def refused(path, words):
    with pytest.raises(GeometryError, match=words) as caught:
        read_mesh(path)
    assert "\n" not in str(caught.value)


def test_what_holds_no_tets_is_refused(write, tmp_path):
    refused(write(CUBE, [("hexahedron", [[0, 1, 3, 2, 4, 5, 7, 6]])]), "1 hexahedron elements; only tets")
    refused(write(CUBE, [("triangle", [[0, 1, 3]])]), "no tets")
    refused(write(CUBE, [("tetra", SIX), ("tetra", SIX[:1])]), "overlaps|share one face")
    refused(write(CUBE, [("tetra", [[0, 1, 2, 3]])]), "no volume")
    refused(write(CUBE * np.nan, [("tetra", SIX)], ".vtu"), "not finite")
    refused(write(CUBE, [("tetra", SIX + 3)], ".vtu"), "not from 0 to 7")
    (tmp_path / "a.stl").write_text("solid")
    refused(tmp_path / "a.stl", "not from '.stl'")


@pytest.mark.parametrize("suffix", [".msh", ".vtu"])
def test_torn_empty_and_foreign_files_are_refused(write, suffix):
    path = write(*[tower(2)[0], [("tetra", tower(2)[1])]], suffix)
    content = path.read_bytes()
    for torn in (b"", content[:5], content[: len(content) // 3], content[: len(content) * 2 // 3], b"\x80\x04" * 500):
        path.write_bytes(torn)
        refused(path, "empty|damaged|no .vtu file")


def test_a_document_type_or_an_encoding_that_could_hide_one_is_refused(tmp_path):
    path = tmp_path / "a.vtu"
    bomb = '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa">' + "".join(
        f'<!ENTITY {chr(98 + k)} "{f"&{chr(97 + k)};" * 10}">' for k in range(9)
    )
    path.write_text(f'<?xml version="1.0"?>{bomb}]><VTKFile type="UnstructuredGrid">&j;</VTKFile>')
    refused(path, "document type")
    path.write_bytes(path.read_text().encode("utf-16"))
    refused(path, "UTF-8")
    path.write_bytes(b'<?xml version="1.0" encoding="cp037"?>' + b"<VTKFile/>")
    refused(path, "encoding")


def vtu(points_data, header="UInt64", compressor=' compressor="vtkZLibDataCompressor"'):
    return (
        f'<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="{header}"{compressor}>'
        '<UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="6"><Points>'
        '<DataArray type="Float64" NumberOfComponents="3" format="binary">'
        f"{points_data}</DataArray></Points><Cells/></Piece></UnstructuredGrid></VTKFile>"
    )


def test_files_that_claim_or_unpack_to_more_than_there_is_are_refused(tmp_path):
    path = tmp_path / "a.vtu"
    packed = zlib.compress(bytes(2**20), 9)
    blocks = 3000
    header = np.array([blocks, 2**20, 2**20] + [len(packed)] * blocks, dtype="<u8").tobytes()
    path.write_text(vtu(base64.b64encode(header).decode() + base64.b64encode(packed * blocks).decode()))
    refused(path, "claims to hold far more")
    huge = np.array([2**62, 0, 0], dtype="<u8").tobytes()
    path.write_text(vtu(base64.b64encode(huge).decode()))
    refused(path, "damaged|claims")
    path = tmp_path / "a.msh"
    for nodes in ("1 99999999999 1 9\n", "1 4 1 9\n3 1 0 4\n1\n2\n3\n90000000000\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"):
        path.write_text(
            f"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n{nodes}$EndNodes\n"
            "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 90000000000\n$EndElements\n"
        )
        refused(path, "damaged|claims")


def test_bytes_changed_anywhere_never_crash_the_reader(write, tmp_path):
    points, tets = tower(2)
    tags = {"gmsh:physical": [np.repeat([1, 2], 6)], "gmsh:geometrical": [np.repeat([1, 2], 6)]}
    paths = [
        write(points, [("tetra", tets)], ".msh", tags, {"a": np.array([1, 3])}, binary=False).rename(
            tmp_path / "1.msh"
        ),
        write(points, [("tetra", tets)], ".msh", tags, {"a": np.array([1, 3])}, binary=True).rename(tmp_path / "2.msh"),
        write(points, [("tetra", tets)], ".vtu", {"group": [np.repeat([1, 2], 6)]}).rename(tmp_path / "3.vtu"),
    ]
    code = """
import sys
import numpy as np
from pathlib import Path
from geometry.blocks import GeometryError
from geometry.files.mesh_files import read_mesh
rng = np.random.default_rng(3)
for path in map(Path, sys.argv[1:]):
    content = path.read_bytes()
    place = path.with_name("torn" + path.suffix)
    for _ in range(120):
        torn = bytearray(content)
        for k in rng.integers(0, len(torn), 3):
            torn[k] = rng.integers(256)
        place.write_bytes(bytes(torn))
        try:
            read_mesh(place)
        except GeometryError as error:
            assert "\\n" not in str(error)
"""
    done = subprocess.run([sys.executable, "-c", code, *map(str, paths)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    assert done.stdout == ""


def test_many_blocks_take_a_time_that_grows_as_their_number(tmp_path):
    cells = Specimen(couplet(1.0, 0.05, 0.05, (600, 1, 1)).blocks)
    export(tmp_path / "many.msh", cells)
    assert read_mesh(tmp_path / "many.msh").blocks.count == 1200
