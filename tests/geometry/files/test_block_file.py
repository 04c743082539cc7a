import subprocess
import sys
from dataclasses import fields, replace

import h5py
import numpy as np
import pytest

from geometry.blocks import Blocks, GeometryError, Specimen, TetMesh
from geometry.files.atomic import whole_file
from geometry.files.blocks_h5 import load_blocks, save_blocks
from geometry.joints.find import find_joints
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.polyhedra.construct import from_faces
from geometry.specimens.stacked import couplet


@pytest.fixture
def specimen():
    return couplet(0.2, 0.05, 0.05, (2, 1, 1), mortar=(0.01, (3, 1, 1)), plates=0.02)


@pytest.fixture
def mesh(specimen):
    return mesh_blocks(specimen.blocks, specimen.blocks.group == 1, 0.05, find_joints(specimen.blocks))[0]


@pytest.fixture
def path(tmp_path, specimen, mesh):
    save_blocks(tmp_path / "a.blocks.h5", specimen, mesh)
    return tmp_path / "a.blocks.h5"


def same(one, two):
    for entry in fields(one):
        a, b = getattr(one, entry.name), getattr(two, entry.name)
        if isinstance(a, np.ndarray):
            assert a.dtype == b.dtype
            assert a.tobytes() == b.tobytes()
        else:
            assert a == b


def test_a_specimen_comes_back_bit_for_bit(path, specimen, mesh):
    again, tets = load_blocks(path)
    same(again.blocks, specimen.blocks)
    same(tets, mesh)
    assert list(again.sets) == list(specimen.sets)
    assert all(np.array_equal(again.sets[name], specimen.sets[name]) for name in specimen.sets)
    assert (again.section, again.shape) == (specimen.section, specimen.shape)


def test_without_tets_none_come_back(tmp_path, specimen):
    save_blocks(tmp_path / "b.blocks.h5", replace(specimen, sets={"every ä block": np.arange(3)}))
    again, tets = load_blocks(tmp_path / "b.blocks.h5")
    assert tets is None
    assert list(again.sets) == ["every ä block"]


def test_a_file_that_cannot_be_written_leaves_nothing_behind(tmp_path, specimen):
    (tmp_path / "old.blocks.h5").write_bytes(b"old")
    with pytest.raises(TypeError):
        save_blocks(tmp_path / "old.blocks.h5", replace(specimen, shape=object()))
    assert [p.name for p in tmp_path.iterdir()] == ["old.blocks.h5"]
    assert (tmp_path / "old.blocks.h5").read_bytes() == b"old"
    with pytest.raises(GeometryError, match="cannot write"):
        save_blocks(tmp_path / "no such folder" / "a.blocks.h5", specimen)


def change(path, name, alter):
    with h5py.File(path, "r+") as file:
        values = file[name][()]
        del file[name]
        file[name] = alter(values)


def put(row, value):
    def alter(values):
        values[row] = value
        return values

    return alter


DAMAGES = {
    "points not finite": ("blocks/points", put((0, 1), np.nan), "not finite"),
    "points as far as the stars": ("blocks/points", lambda p: p * 1e300, "is the unit right"),
    "corner out of range": ("blocks/face_points", put(0, 10**9), "allowed: 0 to"),
    "negative corner": ("blocks/face_points", put(0, -1), "allowed: 0 to"),
    "a face that falls back": ("blocks/face_start", put(1, 9), "at least 3"),
    "a bent face": ("blocks/points", put((0, 0), 1e-6), "not flat"),
    "a face turned inward": ("blocks/face_points", lambda f: np.concatenate([f[3::-1], f[4:]]), "not closed"),
    "all faces inward": ("blocks/points", lambda p: p * [1, 1, -1], "look inward"),
    "group out of range": ("blocks/group", put(0, 7), "allowed: 0 to"),
    "a shape that is no table": ("blocks/points", np.ravel, "shape"),
    "integers as numbers": ("blocks/unit", lambda u: u.astype(float), "integers"),
    "objects": ("blocks/unit", lambda u: np.array([b"x"] * len(u), dtype="S4"), "no array of numbers"),
    "a set of unknown blocks": ("sets/0", put(0, 99), "do not exist"),
    "a tet inside out": ("mesh/tets", lambda t: t[:, [1, 0, 2, 3]], "volume"),
    "a tet of another block": ("mesh/tets", put((0, 0), 10**6), "not the block's"),
    "tets missing": ("mesh/nodes", lambda n: n * 0.9, "fill"),
    "text that is no JSON": ("about", put(0, 7), "damaged"),
}


@pytest.mark.parametrize("name", DAMAGES)
def test_a_damaged_file_is_refused_with_what_is_wrong(path, name):
    member, alter, words = DAMAGES[name]
    change(path, member, alter)
    with pytest.raises(GeometryError, match=words) as caught:
        load_blocks(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("share", [0.0, 0.01, 0.3, 0.7, 0.999])
def test_a_torn_file_is_refused(path, share):
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(GeometryError, match="damaged|empty"):
        load_blocks(path)


def test_what_is_no_file_of_blocks_is_refused(tmp_path):
    for content in (b"ISO-10303-21;", b"\x80\x04\x95", np.random.default_rng(1).bytes(5000)):
        (tmp_path / "x.blocks.h5").write_bytes(content)
        with pytest.raises(GeometryError, match="no file of blocks"):
            load_blocks(tmp_path / "x.blocks.h5")
    with pytest.raises(GeometryError, match="does not exist"):
        load_blocks(tmp_path / "nothing")
    with pytest.raises(GeometryError, match="is no file"):
        load_blocks(tmp_path)


def test_links_to_elsewhere_are_not_followed(path, tmp_path):
    other = tmp_path / "other.h5"
    with h5py.File(other, "w") as file:
        file["points"] = np.zeros((8, 3))
    for link in (h5py.ExternalLink(str(other), "points"), h5py.SoftLink("/about")):
        with h5py.File(path, "r+") as file:
            del file["blocks/points"]
            file["blocks"]["points"] = link
        with pytest.raises(GeometryError, match="link"):
            load_blocks(path)


def test_arrays_that_claim_more_than_the_file_holds_are_not_read(path):
    huge = (10**10, 3)
    for keys in ({"chunks": (1000, 3), "compression": "gzip"}, {"chunks": (1000, 3)}, {}):
        with h5py.File(path, "r+") as file:
            del file["blocks/points"]
            file["blocks"].create_dataset("points", huge, dtype=float, **keys)
        with pytest.raises(GeometryError, match="packed|claims"):
            load_blocks(path)


def test_data_kept_in_another_file_is_not_read(path, tmp_path):
    (tmp_path / "secret").write_bytes(bytes(240))
    with h5py.File(path, "r+") as file:
        del file["blocks/points"]
        file["blocks"].create_dataset("points", (10, 3), dtype=float, external=[(str(tmp_path / "secret"), 0, 240)])
    with pytest.raises(GeometryError, match="another file"):
        load_blocks(path)


def test_bytes_flipped_anywhere_never_crash_the_reader(path, tmp_path):
    code = """
import sys, numpy as np
from pathlib import Path
from geometry.files.blocks_h5 import load_blocks
from geometry.blocks import GeometryError
content = Path(sys.argv[1]).read_bytes()
place = Path(sys.argv[2])
rng = np.random.default_rng(7)
for _ in range(150):
    torn = bytearray(content)
    for k in rng.integers(0, min(len(torn), 9000), 4):
        torn[k] = rng.integers(256)
    place.write_bytes(bytes(torn))
    try:
        load_blocks(place)
    except GeometryError:
        pass
"""
    done = subprocess.run([sys.executable, "-c", code, str(path), str(tmp_path / "t.h5")], capture_output=True)
    assert done.returncode == 0, done.stderr.decode()[-2000:]


def test_a_single_block_with_a_face_of_too_many_corners_is_refused(tmp_path):
    count = 200_000
    faces = 4000
    blocks = Blocks(
        points=np.zeros((4, 3)),
        face_start=np.concatenate([[0], count + 3 * np.arange(faces)]),
        face_points=np.zeros(count + 3 * (faces - 1), dtype=np.int64),
        block_face_start=np.array([0, faces]),
        unit=np.zeros(1, dtype=np.int64),
        group=np.zeros(1, dtype=np.int64),
        groups=("units",),
    )
    save_blocks(tmp_path / "c.blocks.h5", Specimen(blocks))
    with pytest.raises(GeometryError, match="corners"):
        load_blocks(tmp_path / "c.blocks.h5")


def test_a_mesh_of_another_specimen_is_refused(tmp_path, specimen, mesh):
    wrong = TetMesh(mesh.nodes, mesh.node_start[:-1], mesh.tets, mesh.tet_start)
    save_blocks(tmp_path / "d.blocks.h5", specimen, wrong)
    with pytest.raises(GeometryError, match="node_start"):
        load_blocks(tmp_path / "d.blocks.h5")


@pytest.mark.parametrize("name", ["x" * 300, "loop/a", "file/a", "a\0b", "."])
def test_a_name_that_no_file_can_have_is_told_in_one_message(name, tmp_path):
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "file").touch()
    with pytest.raises(GeometryError, match="cannot write"), whole_file(tmp_path / name) as place:
        place.write_text("x")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["file", "loop"]


def test_the_longest_name_that_the_system_allows_can_be_written(tmp_path):
    with whole_file(tmp_path / ("x" * 255)) as place:
        place.write_text("x")
    assert [len(p.name) for p in tmp_path.iterdir()] == [255]


@pytest.mark.parametrize("off", [0.0, 1e-6, -1e-6])
def test_a_face_that_folds_at_a_short_edge_is_refused_since_it_would_lose_its_joint(tmp_path, off):
    """Two corners on an edge of a cube stand in the wrong order, or one of them inside."""
    low = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    high = low + (0, 0, 1)
    extra = np.array([[0.5 + 2e-5, off, 1], [0.5, 0, 1]])
    sides = [np.array([low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]]) for k in range(1, 4)]
    front = np.array([low[0], low[1], high[1], *(extra[::-1] * (1, 0, 1)), high[0]])
    top = np.array([high[0], *extra, *high[1:]])
    folded = from_faces([[low[::-1], top, front, *sides]], [0], [0], ["units"])
    path = tmp_path / "fold.blocks.h5"
    save_blocks(path, Specimen(folded))
    with pytest.raises(GeometryError, match="of block 0 is not convex: a corner lies .* outside"):
        load_blocks(path)
