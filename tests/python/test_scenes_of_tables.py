"""Scenes from a dictionary: those of a file of the same words, blocks within them, messages that name the key."""

import signal
from pathlib import Path

import numpy as np
import pytest

import masonry
from geometry.blocks import GeometryError
from geometry.files.blocks_text import blocks_of_text, text_of_blocks
from geometry.structures.arch import arch
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.runtime.text_files import toml_of
from masonry.scene import to_toml
from masonry.scene.source import packaged
from tests.faults.samples import ALWAYS, ended_after, resume
from tests.geometry.specimens.test_from_arrays import CUBE, QUADS

SIZE = np.array([0.25, 0.12, 0.06])
DRUMS = [((CUBE + [0, 0, k]) * SIZE, QUADS) for k in range(3)]
NAMED = {"blocks": DRUMS, "names": ["bottom", "unit 2", "top"]}
TRIPLET = {"base": "triplet-dry", "specimen": NAMED}


@pytest.mark.parametrize("name", ["couplet", "arch-tilted", "wallette-cyclic", "block-shaken"])
def test_the_tables_of_a_file_give_its_scene(name):
    tables = toml_of(packaged()[name].read_text(encoding="utf-8"), name)
    assert to_toml(masonry.load({"name": name, **tables})) == to_toml(masonry.load(name))


def test_numbers_of_numpy_tuples_paths_and_dotted_keys_are_taken(tmp_path):
    tables = {
        "base": "couplet",
        "drive": {"steps": np.int64(500)},
        "contact.unit_unit.tan_friction_angle": np.float64(0.9),
    }
    scene = masonry.load({**tables, "support": ({"on": ("bottom",), "fix": np.array(["x", "y"])},)})
    assert scene.drive.steps == 500 and scene.contact["unit_unit"].tan_friction_angle == 0.9
    assert scene.support[0].on == "bottom" and scene.support[0].fix == ("x", "y") and scene.name == "scene"
    (tmp_path / "own.toml").write_text("base = 'couplet'\nlaw = 'linear'\n")
    assert masonry.load({"base": tmp_path / "own.toml"}).law == "linear"


def test_blocks_that_are_handed_over_slide_as_the_packaged_ones():
    own, shipped = masonry.run(TRIPLET), masonry.run("triplet-dry")
    assert own.summary["peak_force_n"] == pytest.approx(shipped.summary["peak_force_n"], rel=1e-9)


def test_the_result_stands_alone_and_runs_again_with_the_same_bits(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = masonry.run({**TRIPLET, "drive.displacement": "0.01 mm"})
    result.save("out")
    again = masonry.run(masonry.load("out/scene.toml"))
    assert np.array_equal(again.history.rows["force"], result.history.rows["force"])
    assert masonry.load_result("out").specimen.blocks.count == 3


def test_its_run_is_resumed_with_the_same_bits(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("own.toml").write_text(to_toml(masonry.load({**TRIPLET, "drive.displacement": "0.01 mm"})))
    assert main(["run", "own.toml", "--quiet", *ALWAYS, "--out", "whole"]) == 0
    with ended_after(10, signal.SIGINT, monkeypatch):
        assert main(["run", "own.toml", "--quiet", *ALWAYS, "--out", "parts"]) == 130
    assert resume(tmp_path / "parts") == 0
    rows = [masonry.load_result(tmp_path / name).history.rows["force"] for name in ("whole", "parts")]
    assert np.array_equal(*rows)


def test_a_specimen_of_geometry_is_the_structure_of_a_scene_with_its_sets():
    stones = arch(1.0, np.pi, 15, 0.15, 0.3)
    scene = masonry.load({"base": "arch-tilted", "specimen": {"blocks": stones, "contact_points": "vertex"}})
    table = {
        "kind": "arch",
        "radius": "1 m",
        "angle": "180 deg",
        "voussoirs": 15,
        "thickness": "150 mm",
        "depth": "300 mm",
    }
    built = masonry.load({"base": "arch-tilted", "specimen": {**table, "contact_points": "vertex"}})
    assert masonry.limit(scene).factor == pytest.approx(masonry.limit(built).factor, rel=1e-6)
    assert masonry.load({"base": "arch-tilted", "specimen": stones.blocks}).specimen.content is not None


def test_a_text_of_blocks_gives_them_back_bit_for_bit_and_the_same_each_time():
    stones = arch(1.0, np.pi, 15, 0.15, 0.3)
    text = text_of_blocks(stones)
    again, mesh = blocks_of_text(text)
    assert text == text_of_blocks(again) and mesh is None
    assert np.array_equal(again.blocks.points, stones.blocks.points) and list(again.sets) == list(stones.sets)


@pytest.mark.parametrize(
    "text", ["abc", "YWJj", "eNrzSM3JyQcABYwB9Q==", "ü", text_of_blocks(arch(1.0, 3.0, 3, 0.1, 0.1))[:-40]]
)
def test_another_text_is_no_text_of_blocks(text):
    with pytest.raises(GeometryError, match="no text of blocks|the blocks"):
        blocks_of_text(text)
    with pytest.raises(SceneError, match=r"specimen\.content: "):
        masonry.check({"base": "triplet-dry", "specimen": {"kind": "file", "content": text}})


def test_a_list_of_sets_holds_all_of_them():
    both = {"base": "triplet-dry", "support": [{"on": ["bottom", "top"], "fix": ["y", "z", "rotation"]}]}
    summary = masonry.run({**both, "drive.displacement": "0.01 mm"}).summary
    assert "support.0" in summary["reactions"] or "bottom + top" in str(summary["reactions"])
    faces = masonry.load(
        {"base": "triplet-dry", "traction": [{"on": ["top.x+", "unit 2.x+"], "stress": {"x": "-1 kPa"}}]}
    )
    assert (
        faces.traction[0].on == "top.x+ + unit 2.x+" and masonry.load(dict(faces.resolved())).traction == faces.traction
    )
    assert masonry.check(faces)["blocks"] == 3


WRONG = {
    "no tables": ({}, "is no scene"),
    "no key": ({5: 1}, "5 is no key"),
    "key": ({"base": "couplet", "lwa": "linear"}, "lwa: unknown key; did you mean 'law'"),
    "dotted key": ({"base": "couplet", "contact.unit_unit.cohesoin": "1 MPa"}, "did you mean 'cohesion'"),
    "value": ({"base": "couplet", "confinement": "3"}, "^confinement: '3' has no unit"),
    "none": ({"base": "couplet", "law": None}, "law: None is no value of a scene; leave the key out"),
    "object": ({"base": "couplet", "drive": {"on": object()}}, r"drive\.on: .* is no value of a scene"),
    "base": ({"base": "cuplet"}, "^base: no scene 'cuplet': no such file; did you mean 'couplet'"),
    "blocks and a path": ({"base": "triplet-dry", "specimen": {**NAMED, "path": "x"}}, r"specimen\.path: unknown key"),
    "word of bodies": ({"base": "triplet-dry", "specimen": {"blocks": DRUMS, "name": []}}, "did you mean 'names'"),
    "another kind": ({"base": "triplet-dry", "specimen": {**NAMED, "kind": "arch"}}, "are of kind 'file'"),
    "no blocks": ({"base": "triplet-dry", "specimen": {"blocks": "stones.obj"}}, "give a list of bodies"),
    "neither": ({"base": "triplet-dry", "specimen": {"kind": "file"}}, r"specimen\.path: missing"),
    "no sets": ({"base": "couplet", "support": [{"on": [], "fix": "all"}]}, "a list of names"),
    "set and face": ({"base": "triplet-dry", "drive.on": ["unit 2", "top.z+"]}, "whole blocks and faces"),
    "one of several": ({"base": "triplet-dry", "drive.on": ["unit 2", "topp"]}, "'topp' selects nothing"),
}  # fmt: skip


@pytest.mark.parametrize(("tables", "message"), WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_said_by_its_key(tables, message):
    with pytest.raises(SceneError, match=message):
        masonry.check(tables)


def test_tables_that_hold_themselves_end_in_a_message():
    tables = {"base": "couplet"}
    tables["drive"] = tables
    with pytest.raises(SceneError, match="nested too deeply"):
        masonry.load(tables)
