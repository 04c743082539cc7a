"""JSON of COMPAS: models, assemblies and meshes of its versions 1 and 2 give the same three bricks and two joints."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

import masonry
import tests.geometry.files.compas_samples as samples
from geometry.blocks import GeometryError
from geometry.files.surfaces.compas_json import read_compas
from geometry.polyhedra.measures import bounds, volumes
from masonry.cli.main import main
from masonry.errors import SceneError
from tests.geometry.files.compas_samples import (
    HEIGHT,
    IDENTITY,
    LENGTH,
    WIDTH,
    element,
    matrix,
    mesh,
    model,
    thing,
    write,
)

POLYHEDRON = thing("compas.geometry/Polyhedron", {"vertices": samples.corners(2 * HEIGHT), "faces": samples.FACES})
FRAME = {"point": [LENGTH / 2, WIDTH / 2, 1.5 * HEIGHT], "xaxis": [0.0, 1.0, 0.0], "yaxis": [-1.0, 0.0, 0.0]}
BOX = thing("compas.geometry/Box", {"xsize": WIDTH, "ysize": LENGTH, "zsize": HEIGHT, "frame": FRAME})


def three_pieces():
    """Data of one mesh with three closed parts."""
    points = [at for k in range(3) for at in samples.corners(k * HEIGHT)]
    loops = [[8 * k + v for v in face] for k in range(3) for face in samples.FACES]
    vertex = {str(n): dict(zip("xyz", at, strict=True)) for n, at in enumerate(points)}
    return {"vertex": vertex, "face": {str(n): loop for n, loop in enumerate(loops)}}


def wrapped(one):
    """As version 0.17 has it: what it holds stands with its class in a table of its own."""
    inside = {"compas": "0.17.2", "datatype": one["dtype"], "data": one["value"]}
    return {"dtype": one["dtype"], "value": inside}


FILES = {
    "a model": model(),
    "an assembly": samples.assembly(),
    "an assembly of version 1": samples.assembly(1),
    "meshes": [mesh(k * HEIGHT, name=f"brick {k}") for k in range(3)],
    "meshes of version 1": [mesh(k * HEIGHT, 1) for k in range(3)],
    "a table of meshes": {"blocks": [mesh(), mesh(HEIGHT)], "key": mesh(2 * HEIGHT)},
    "bare data of meshes": [samples.mesh_data(k * HEIGHT) for k in range(3)],
    "a mesh, a box in its frame and a polyhedron": [mesh(), BOX, POLYHEDRON],
    "meshes of version 0.17": [wrapped(mesh(k * HEIGHT, 1, f"brick {k}")) for k in range(3)],
    "a mesh of three pieces": thing("compas.datastructures/Mesh", three_pieces()),
}


@pytest.mark.parametrize("content", FILES.values(), ids=FILES)
def test_three_bricks_and_two_joints_come_of_all_of_them(tmp_path, content):
    report = masonry.import_blocks(write(tmp_path / "bricks.json", content))
    blocks = report.specimen.blocks
    assert volumes(blocks) == pytest.approx(np.full(3, LENGTH * WIDTH * HEIGHT), rel=1e-12)
    assert np.sort(bounds(blocks)[0][:, 2]) == pytest.approx([0.0, HEIGHT, 2 * HEIGHT], abs=1e-12)
    assert len(report.joints.patch_start) - 1 == 2 and report.joints.area.sum() == pytest.approx(2 * LENGTH * WIDTH)


@pytest.mark.parametrize("content", [model(), samples.assembly(), samples.assembly(1)], ids=["model", "2", "1"])
def test_the_supports_of_the_file_are_those_of_the_scene_which_is_run_and_analysed(tmp_path, content, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "bricks.json", content)
    assert main(["import", "bricks.json", "--out", "bricks.toml"]) == 0
    scene = masonry.load("bricks.toml", {"limit": {"pattern": "tilt", "about": "y"}})
    assert scene.support[0].on == "support" and "support" not in scene.assumptions
    assert masonry.limit(scene).factor == pytest.approx(0.6, rel=1e-6)  # the friction that the import puts in


def test_names_are_those_of_the_file_else_numbers(tmp_path):
    named = {"d": element("d", geometry=mesh(3 * HEIGHT, name="its mesh"))}
    names = [surface.name for surface in read_compas(write(tmp_path / "m.json", model(**named)))]
    assert names == ["support", "middle", "block 3", "block 4"]
    listed = [mesh(name="keystone"), mesh(HEIGHT, 1, "springer"), mesh(2 * HEIGHT)]
    names = [surface.name for surface in read_compas(write(tmp_path / "m.json", listed))]
    assert names == ["keystone", "springer", "block 2"]


def test_lists_in_a_table_number_their_blocks_through_the_file(tmp_path):
    courses = {
        "courses": [[mesh(), mesh(HEIGHT, name="tie")], [mesh(2 * HEIGHT), mesh(3 * HEIGHT)]],
        "params": {"N": "2"},
    }
    report = masonry.import_blocks(write(tmp_path / "m.json", courses))
    assert report.names == ("block 0", "tie", "block 2", "block 3") and report.notes[:-1] == ()
    assert [report.specimen.sets[name].tolist() for name in report.names] == [[0], [1], [2], [3]]


def test_what_lists_hold_besides_blocks_is_told(tmp_path):
    point, loads = thing("compas.geometry/Point", [0.0, 0.0, 1.0]), {"load": 3}
    report = masonry.import_blocks(write(tmp_path / "m.json", [mesh(), point, mesh(HEIGHT), [point, loads]]))
    assert report.specimen.blocks.count == 2
    assert "which was left out: 2 of compas.geometry/Point, 1 of a table" in " ".join(report.notes)


def test_names_that_several_blocks_have_are_told_but_for_supports(tmp_path):
    listed = [mesh(k * HEIGHT, name=name) for k, name in enumerate(("brick", "tie", "brick", "support", "support"))]
    report = masonry.import_blocks(write(tmp_path / "m.json", listed))
    notes = [note for note in report.notes if "names of several blocks" in note]
    assert len(notes) == 1 and "'brick' (2); a support, load or gauge" in notes[0]


def test_places_of_model_group_and_element_are_applied_one_after_the_other(tmp_path):
    turned = [[0.0, -1.0, 0.0, 5.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 7.0], IDENTITY[3]]
    blocks = masonry.import_blocks(write(tmp_path / "m.json", model(matrix(turned)))).specimen.blocks
    low, high = bounds(blocks)
    assert low.min(axis=0) == pytest.approx([5.0 - WIDTH, 0.0, 7.0]) and high[2, 2] == pytest.approx(7.0 + 3 * HEIGHT)
    assert high.max(axis=0)[:2] == pytest.approx([5.0, LENGTH])


def test_a_frame_places_a_block_that_is_alike_along_none_of_its_axes(tmp_path):
    """Its x along y, its y against x, of lengths that do not count: a brick that begins at the frame, not in its
    middle."""
    frame = {"point": [5.0, 1.0, 2.0], "xaxis": [0.0, 2.0, 0.0], "yaxis": [-3.0, 0.5, 0.0]}
    placed = model(b=element("b", frame, name="middle"))
    (surface,) = (one for one in read_compas(write(tmp_path / "m.json", placed)) if one.name == "middle")
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    assert low == pytest.approx([5.0 - WIDTH, 1.0, 2.0]) and high == pytest.approx([5.0, 1.0 + LENGTH, 2.0 + HEIGHT])


def test_a_block_says_by_itself_that_it_is_a_support(tmp_path):
    """Of compas_assembly: its attribute, where the node says nothing."""
    content = samples.assembly()
    nodes = content["data"]["graph"]["data"]["node"]
    del nodes["0"]["is_support"]
    nodes["2"]["block"]["data"]["attributes"]["is_support"] = True
    names = [surface.name for surface in read_compas(write(tmp_path / "m.json", content))]
    assert names == ["block 0", "block 1", "support"]


def test_a_mirrored_model_looks_outwards_and_millimetres_are_told_by_unit(tmp_path):
    mirror = [[-1000.0, 0.0, 0.0, 0.0], [0.0, 1000.0, 0.0, 0.0], [0.0, 0.0, 1000.0, 0.0], IDENTITY[3]]
    report = masonry.import_blocks(write(tmp_path / "m.json", model(matrix(mirror))), unit="mm")
    assert volumes(report.specimen.blocks) == pytest.approx(np.full(3, LENGTH * WIDTH * HEIGHT), rel=1e-9)
    assert any("looked inwards" in note for note in report.notes)


BEAM = {"dtype": "compas_model.elements/BeamElement", "guid": "c", "data": {"width": 1}}
THREE_AT_AN_EDGE = {str(n): face for n, face in enumerate([*samples.FACES, [0, 1, 6]])}
WRONG = {
    "no JSON": ("{", "is no JSON"),
    "not finite": ('{"vertex": {"0": {"x": NaN}}, "face": {}}', "NaN is no number"),
    "nothing": ("[]", "holds no blocks of COMPAS: a Mesh"),
    "another file": ('{"a": 1}', "holds no blocks of COMPAS"),
    "deep": ("[" * 5000 + "]" * 5000, "nested too deeply"),
    "an element without a mesh": (model(c=BEAM), "BeamElement, holds no mesh"),
    "a node without a block": ({"node": {"0": {"x": 1.0}}, "edge": {}}, "node 0 holds no block"),
    "a vertex that is not there": ({"vertex": {"0": {}}, "face": {"0": [0, 1, 2]}}, "a face names a vertex"),
    "no numbers": ({"vertex": {"0": {"x": "a"}}, "face": {}}, "a vertex is not three numbers"),
    "a mesh without faces": ([mesh(), thing("own/Mesh", {"vertex": {}})], "block 1, a own/Mesh, has not the tables"),
    "a box without sizes": ({"a": thing("compas.geometry/Box", {"xsize": 1.0})}, "a, a compas.geometry/Box, has not"),
    "a node's odd block": ({"node": {"5": {"block": thing("own/Block", {"a": 1})}}}, "node 5 holds a block without"),
    "a matrix": (model({"matrix": [[1.0]]}), "neither a matrix of 4 x 4 numbers"),
    "a projection": (model(matrix([*IDENTITY[:3], [0.0, 0.0, 0.1, 1.0]])), "neither a matrix"),
    "open": (thing("Mesh", samples.mesh_data() | {"face": {"0": [0, 1, 2, 3], "1": [0, 3, 5, 4]}}), "open|edge"),
    "not a manifold": (samples.mesh_data() | {"face": THREE_AT_AN_EDGE}, "edge|faces"),
}  # fmt: skip


@pytest.mark.parametrize(("content", "message"), WRONG.values(), ids=WRONG)
def test_what_cannot_be_read_is_one_message(tmp_path, content, message, capsys):
    path = tmp_path / "wrong.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    with pytest.raises(GeometryError, match=message):
        masonry.import_blocks(path)
    assert main(["import", str(path), "--out", str(tmp_path / "new.toml")]) == 2
    assert capsys.readouterr().err.count("\n") == 1 and not (tmp_path / "new.toml").exists()


def test_words_of_an_import_are_named_where_they_are_wrong(tmp_path):
    path = write(tmp_path / "m.json", model())
    for words, message in (
        ({"tolerence": "1 mm"}, "tolerence: unknown; .*did you mean 'tolerance'"),
        ({"unit": "quark"}, "unit: 'quark' is no known unit"),
        ({"up": "w"}, "up 'w': allowed: x, y, z"),
        ({"groups": "a=b"}, "give a dictionary"),
        ({"groups": {"nothing*": "units"}}, "no solid has such a name"),
        ({"open_gaps": 1}, "give True or False"),
    ):
        with pytest.raises(SceneError, match=message):
            masonry.import_blocks(path, **words)
    with pytest.raises(SceneError, match=r"'\.xyz'|is not read"):
        masonry.import_blocks(tmp_path / "m.xyz")


def test_an_import_writes_what_the_command_writes_and_its_scene_runs_with_and_without_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "bricks.json", model())
    report = masonry.import_blocks("bricks.json", "own.toml", groups={"middle": "stone"})
    assert main(["import", "bricks.json", "--out", "other.toml", "--group", "middle=stone"]) == 0
    files = [(tmp_path / name).read_text().replace("own.", "other.") for name in ("own.toml", "other.toml")]
    assert files[0] == files[1] and "written  own.toml" in repr(report)
    inside = masonry.import_blocks("bricks.json", groups={"middle": "stone"})
    tilt = {"limit": {"pattern": "tilt", "about": "y"}}
    factors = [masonry.limit(scene.with_(tilt)).factor for scene in (report.scene, inside.scene)]
    assert factors[0] == factors[1] and inside.scene.name == "bricks" and inside.paths == ()


def test_objects_of_compas_are_taken_as_they_are():
    bricks = [
        SimpleNamespace(to_vertices_and_faces=lambda k=k: (samples.corners(k * HEIGHT), samples.FACES))
        for k in range(3)
    ]
    elements = [SimpleNamespace(modelgeometry=brick) for brick in bricks]
    model_object, assembly_object = (
        SimpleNamespace(elements=lambda: iter(elements)),
        SimpleNamespace(blocks=lambda: iter(bricks)),
    )
    for specimen in (
        bricks,
        elements,
        model_object,
        assembly_object,
        {"blocks": model_object, "names": ["a", "b", "c"]},
    ):
        support = [{"on": "bottom", "fix": "all"}]
        scene = {"base": "triplet-dry", "specimen": specimen, "support": support, "drive.on": "top"}
        assert masonry.check(scene)["blocks"] == 3
