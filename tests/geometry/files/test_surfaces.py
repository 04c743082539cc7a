"""Closed surfaces from OBJ, PLY and STL files: which bodies, what is mended, what is refused; and out again."""

import numpy as np
import pytest

from geometry.blocks import GeometryError, Specimen
from geometry.files.export import export
from geometry.files.surfaces.reader import read_surfaces
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import from_boxes
from geometry.polyhedra.measures import centroids, volumes
from geometry.polyhedra.validate import require_sound
from geometry.specimens.from_arrays import polyhedra
from geometry.specimens.placed import rotation
from tests.geometry.files.surface_files import CUBE, corners, obj


def test_groups_of_an_obj_file_are_blocks_in_its_unit(tmp_path):
    path = obj(tmp_path / "a.obj", corners(), corners((1, 0, 0), (2, 1, 1)))
    solids = read_surfaces(path, unit=0.1)
    assert solids.names == ("body0", "body1")
    assert volumes(solids.blocks) == pytest.approx([1e-3, 2e-3], rel=1e-12)
    assert find_joints(solids.blocks).area.sum() == pytest.approx(0.01, rel=1e-12)
    assert solids.notes == ()
    assert "taken as 1 m" in read_surfaces(path).notes[0]


def test_every_way_of_writing_a_face_is_read(tmp_path):
    lines = ["# a cube", *("v {} {} {} 0.5 0.5 0.5".format(*point) for point in corners().tolist()), "vn 0 0 1"]
    lines += ["f 1//1 4/2 3/2/1 \\", "2", "f -4 -3 -2 -1", *("f {} {} {} {}".format(*face) for face in CUBE[2:])]
    (tmp_path / "a.obj").write_text("\n".join(lines))
    solids = read_surfaces(tmp_path / "a.obj")
    assert volumes(solids.blocks) == pytest.approx([1.0]) and solids.names == ("a",)


def test_bodies_without_groups_are_told_apart_by_their_corners(tmp_path):
    solids = read_surfaces(obj(tmp_path / "a.obj", corners(), corners((1, 0, 0)), head=""))
    assert solids.blocks.count == 2 and len(find_joints(solids.blocks).patch_start) == 2


def test_a_surface_whose_faces_share_no_corners_is_closed(tmp_path):
    points = np.concatenate([corners()[np.array(face) - 1] for face in CUBE])
    faces = np.arange(1, 25).reshape(6, 4).tolist()
    solids = read_surfaces(obj(tmp_path / "a.obj", points, faces=faces))
    assert volumes(solids.blocks) == pytest.approx([1.0])


@pytest.mark.parametrize("turned", [range(6), (0, 3)])
def test_faces_that_look_inwards_are_turned_and_told(tmp_path, turned):
    faces = [face[::-1] if f in turned else face for f, face in enumerate(CUBE)]
    solids = read_surfaces(obj(tmp_path / "a.obj", corners(), corners((2, 0, 0)), faces=faces), 1.0)
    assert volumes(solids.blocks) == pytest.approx([1.0, 1.0])
    assert solids.notes == ("blocks with faces that looked inwards, which were turned: 2",)


def test_a_face_that_is_there_twice_is_left_out_and_told(tmp_path):
    solids = read_surfaces(obj(tmp_path / "a.obj", corners(), faces=[*CUBE, CUBE[0], CUBE[4][::-1], (1, 1, 2)]), 1.0)
    assert volumes(solids.blocks) == pytest.approx([1.0])
    assert solids.notes[0].endswith("left out: 2") and solids.notes[1].endswith("left out: 1")


def test_a_hole_is_closed_only_if_it_is_asked_for(tmp_path):
    path = obj(tmp_path / "a.obj", corners(), faces=CUBE[:5])
    for holes in (0.0, 1.4):  # the hole is a square, sqrt(2) wide
        with pytest.raises(GeometryError, match=r"'a.obj' is not closed: 4 of 12 edges .* at \(0, 0.5, 0\).*--holes"):
            read_surfaces(path, holes=holes)
    solids = read_surfaces(path, 1.0, holes=1.42)
    assert volumes(solids.blocks) == pytest.approx([1.0])
    assert solids.notes == ("holes that were closed, of up to 1.41e+03 mm: 1",)


def test_neighbours_cut_the_bent_face_that_they_share_alike(tmp_path):
    rng = np.random.default_rng(1)
    grid = np.stack(np.meshgrid(*[np.arange(4.0)] * 3, indexing="ij"), axis=-1)
    grid[1:3, 1:3, 1:3] += rng.uniform(-0.2, 0.2, (2, 2, 2, 3))  # the outer faces stay flat
    cells = []
    for i, j, k in np.ndindex(3, 3, 3):
        unit = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
        cells.append(np.array([grid[i + a, j + b, k + c] for a, b, c in unit]))
    solids = read_surfaces(obj(tmp_path / "a.obj", *cells), 1.0)
    require_sound(solids.blocks)
    assert volumes(solids.blocks).sum() == pytest.approx(27.0, rel=1e-12)  # nothing overlaps, nothing gapes
    joints = find_joints(solids.blocks)
    pairs = np.unique(np.stack([joints.block_a, joints.block_b]), axis=1)
    assert pairs.shape[1] == 3 * 2 * 3 * 3  # every inner face
    assert "faces that are not flat" in solids.notes[0]


def test_equal_cuts_of_a_face_are_made_the_same_on_both_sides(tmp_path):
    """A saddle: by symmetry both diagonals make the same area."""
    lower, upper = corners(), corners((0, 0, 1))
    for v, rise in enumerate((0.2, -0.2, 0.2, -0.2)):
        lower[4 + v, 2] += rise
        upper[v, 2] += rise
    solids = read_surfaces(obj(tmp_path / "a.obj", lower, upper), 1.0)
    assert volumes(solids.blocks).sum() == pytest.approx(2.0, rel=1e-12)
    assert len(find_joints(solids.blocks).patch_start) == 3


@pytest.mark.parametrize("degrees", [0, 50, 100, 170, 250])
def test_a_polygon_that_is_bent_along_a_line_is_cut_along_it(tmp_path, degrees):
    """A roof of two flat halves, given as one face of six corners."""
    points = np.array([(x, y, 0.0) for y in (0.0, 2.0) for x in (-1.0, 0.0, 1.0)])
    top = points + np.array([(0, 0, 1.0 if x else 1.2) for x in points[:, 0]])
    faces = [(1, 4, 5, 6, 3, 2), (7, 8, 9, 12, 11, 10), (1, 2, 3, 9, 8, 7), (4, 10, 11, 12, 6, 5), (1, 7, 10, 4)]
    turned = np.concatenate([points, top]) @ rotation((0.0, 0.0, 1.0), np.radians(degrees)).T
    solids = read_surfaces(obj(tmp_path / "a.obj", turned, faces=[*faces, (3, 6, 12, 9)]), 1.0)
    assert volumes(solids.blocks) == pytest.approx([2 * 2 * 1.1], rel=1e-12)


def write(path, specimen):
    export(path, specimen)
    return read_surfaces(path, 1.0)


def test_stl_and_ply_are_read(tmp_path):
    import trimesh

    mesh = trimesh.creation.box((1.0, 2.0, 3.0))
    for name in ("a.stl", "b.ply", "c.obj"):
        mesh.export(tmp_path / name)
        solids = read_surfaces(tmp_path / name)
        assert volumes(solids.blocks) == pytest.approx([6.0]) and len(solids.blocks.face_start) == 7
    folder = tmp_path / "blocks"
    folder.mkdir()
    for number in (10, 2, 1):
        mesh.apply_translation((0, 0, 3.0))
        mesh.export(folder / f"stone_{number}.ply")
    solids = read_surfaces(folder)
    assert solids.names == ("stone_1", "stone_2", "stone_10")
    assert np.argsort(-centroids(solids.blocks)[:, 2]).tolist() == [0, 1, 2]


@pytest.mark.parametrize("suffix", [".obj", ".stl"])
def test_what_is_written_comes_back_to_the_last_digits(tmp_path, suffix):
    """Boxes that touch, and a cross whose faces are convex pieces with corners on each other's edges."""
    rng = np.random.default_rng(2)
    low = np.array([[0, 0, 0], [1 / 3, 0, 0], [0, 0, 0.7]])
    boxes = from_boxes(low, np.array([[1 / 3, 1, 0.7], [2, 1, 0.7], [2, 1, 1.1]]), [0, 1, 2], [0, 0, 0], ("units",))
    arm = np.array([(1.0, -1.0), (3.0, -1.0), (3.0, 1.0)])
    outline = np.concatenate([arm @ np.linalg.matrix_power(np.array([[0, 1], [-1, 0]]), k) for k in range(4)])
    points = np.concatenate([np.insert(outline, 2, z, axis=1) for z in (0.0, 1.0)]) + rng.uniform(size=3)
    n = len(outline)
    sides = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    cross = polyhedra([(points, [list(range(n))[::-1], list(range(n, 2 * n)), *sides])], ["cross"], [0], ["units"])
    for blocks in (boxes, cross):
        copy = write(tmp_path / f"a{suffix}", Specimen(blocks, {"lone": np.array([0])}))
        assert copy.names[0] == ("a" if blocks is cross and suffix == ".stl" else "lone") and copy.notes == ()
        assert volumes(copy.blocks) == pytest.approx(volumes(blocks), rel=1e-12)
        assert len(find_joints(copy.blocks).patch_start) == len(find_joints(blocks).patch_start)
    assert len(write(tmp_path / f"a{suffix}", Specimen(boxes)).blocks.face_start) == len(boxes.face_start)


PINCHED = corners()
PINCHED[6] = (-0.5, 0.5, -0.5)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (("v 0 0 0\nv nan 0 0\n",), "line 2: a corner is three numbers"),
        (("v 0 0\n",), "line 1: a corner is three numbers"),
        (("v 0 0 1e300\n",), "line 1: a corner"),
        (("v 0 0 0\nf 1 2 3\n",), "line 2: a face is three or more numbers of the 1 corners before it"),
        (("f 1 x 3\n",), "line 1: a face"),
        (("hello\n",), "holds no faces"),
        ((corners(), CUBE[:2]), "not closed: 8 of 8 edges"),
        ((corners(), [(1, 3, 4, 2), *CUBE[1:]]), "not closed"),
        ((corners(size=(1, 1, 0)), CUBE), "face"),
        ((PINCHED, CUBE), r"goes through itself at \("),
        ((corners(size=(0, 0, 0)), CUBE), "all its corners lie in one point"),
    ],
)
def test_what_is_no_closed_body_is_refused_in_one_sentence(tmp_path, text, said):
    path = tmp_path / "bad.obj"
    if isinstance(text[0], str):
        path.write_text(text[0])
    else:
        obj(path, text[0], faces=text[1])
    with pytest.raises(GeometryError, match=said) as error:
        read_surfaces(path)
    assert "bad.obj" in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize("name", ["a.stl", "a.ply"])
@pytest.mark.parametrize(
    "content", [b"\0" * 84, b"solid a\nfacet\nvertex 1 2\nendsolid", b"ply\nformat ascii 1.0\n", b"x"]
)
def test_damaged_files_are_refused(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(GeometryError, match=name):
        read_surfaces(tmp_path / name)


def test_a_folder_without_surfaces_is_refused(tmp_path):
    with pytest.raises(GeometryError, match="holds no .obj, .ply, .stl"):
        read_surfaces(tmp_path)


def test_bodies_that_share_an_edge_and_its_corners_are_refused(tmp_path):
    points = np.concatenate([corners(), corners((1, 1, 0))[[1, 2, 3, 5, 6, 7]]])
    other = {1: 3, 2: 9, 3: 10, 4: 11, 5: 7, 6: 12, 7: 13, 8: 14}
    faces = [*CUBE, *(tuple(other[v] for v in face) for face in CUBE)]
    with pytest.raises(GeometryError, match=r"4 faces meet at the edge at \(1, 1, 0.5\)"):
        read_surfaces(obj(tmp_path / "a.obj", points, faces=faces))


def test_sound_bodies_beside_others_are_read_as_each_would_be_alone(tmp_path):
    triangles = [(face[0], *pair) for face in CUBE for pair in zip(face[1:], face[2:], strict=False)]
    mixed = [CUBE[0][::-1], *CUBE[1:]]
    turned = rotation((1.0, 2.0, 3.0), 0.4)
    bodies = [(corners(), CUBE), (np.round(corners() @ turned.T, 6), triangles), (corners(), mixed)]
    alone = [read_surfaces(obj(tmp_path / "a.obj", points, faces=faces)).blocks for points, faces in bodies]
    lines, before = [], 0
    for n, (points, faces) in enumerate(bodies):
        lines += [f"o stone{n}", *("v {!r} {!r} {!r}".format(*point) for point in points.tolist())]
        lines += ["f " + " ".join(str(v + before) for v in face) for face in faces]
        before += len(points)
    (tmp_path / "b.obj").write_text("\n".join(lines))
    together = read_surfaces(tmp_path / "b.obj")
    assert together.names == ("stone0", "stone1", "stone2") and "inwards, which were turned: 1" in together.notes[0]
    ends = together.blocks.face_start[together.blocks.block_face_start]
    for blocks, begin, end in zip(alone, ends[:-1], ends[1:], strict=True):
        here = together.blocks.points[together.blocks.face_points[begin:end]]
        assert here == pytest.approx(blocks.points[blocks.face_points], abs=1e-12)


def test_of_two_bodies_that_are_wrong_the_first_is_told(tmp_path):
    crossed = corners()
    crossed[4:] = crossed[:4]
    path = obj(tmp_path / "a.obj", crossed, corners((2, 0, 0)))
    path.write_text("\n".join(path.read_text().splitlines()[:-1]))
    with pytest.raises(GeometryError, match="^'body0'"):
        read_surfaces(path)
