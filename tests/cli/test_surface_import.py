"""From surfaces to a dry scene: checked, analysed and run on the same joints; there and back; what is refused."""

import numpy as np
import pytest

import masonry
from geometry.files.blocks_h5 import load_blocks
from geometry.polyhedra.measures import volumes
from geometry.specimens.placed import rotation
from masonry.assembly.assemble import assemble, joined
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.importing.data_sets import DATA_SETS
from masonry.scene import load
from tests.geometry.files.surface_files import CUBE, corners, obj

PUSHED = {"limit": {"pattern": "weight", "direction": "x"}}
TILT = {"limit": {"pattern": "tilt", "about": "y"}}
WITHIN = {"law": "elastic", "normal_stiffness": "1 GPa/m", "shear_stiffness": "1 GPa/m"}
COUNTS = {  # blocks, volume (m3), joints
    "wall.obj": (38, 4.365625, 91),
    "dome.obj": (90, 37.83329564, 250),
    "crossvault.obj": (184, 55.06649119, 488),
    "stones": (39, 0.1540578678, 80),
}

TILTS = {"wall.obj": 0.6, "dome.obj": 0.725976, "crossvault.obj": 0.316195, "stones": 0.268146}


def imported(folder, name, *words):
    out = folder / "new.toml"
    assert main(["import", name, *words, "--out", str(out), "--overwrite"]) == 0
    return out


@pytest.fixture(scope="module")
def wall(tmp_path_factory):
    """The packaged wall, whose head joints gape by 25 mm and are bridged."""
    data = DATA_SETS[0]
    return imported(tmp_path_factory.mktemp("wall"), data.name, *data.options)


def complaint(capsys, *words):
    assert main(list(map(str, words))) == 2
    said = capsys.readouterr().err
    assert said.startswith("masonry: ") and said.count("\n") == 1 and "Traceback" not in said
    return said


def test_a_wall_with_gaps_stands_and_slides_at_its_friction(wall):
    scene = load(wall)
    specimen, joints = joined(scene)
    stated = specimen.joints
    assert "gaps of up to 25 mm" in scene.assumptions["specimen.path"]
    assert (specimen.blocks.count, len(stated.block_a)) == COUNTS["wall.obj"][::2]
    head = stated.gap[:, 1] > 1e-6
    assert head.sum() == 31 and stated.gap[head] == pytest.approx(0.025, rel=1e-9)
    result = masonry.run(scene)
    assert result.summary["unbalanced_after_settling"] < 1e-9
    assert result.joints.point == pytest.approx(assemble(scene).joints.point)
    assert masonry.limit(load(wall, TILT)).factor == pytest.approx(0.6, rel=1e-9)


def test_the_run_and_the_limit_analysis_have_the_same_joints(wall):
    run, limit = joined(load(wall))[1], masonry.limit(load(wall, TILT)).joints
    assert np.array_equal(run.patch_points, limit.patch_points) and np.array_equal(run.block_b, limit.block_b)
    assert len(run.point) == len(limit.point)  # the corners: the scene's own points


def test_the_gap_that_is_mended_and_the_gap_that_is_bridged_bear_alike(tmp_path, wall):
    """Closed gaps make each stone longer; friction alone decides when the wall slides."""
    mended = imported(tmp_path, "wall.obj", "--tolerance", "25 mm")
    specimen = load_blocks(tmp_path / "new.blocks.h5")[0]
    assert specimen.joints is None
    assert volumes(specimen.blocks).sum() == pytest.approx(5.1 * 0.5 * 1.75, rel=1e-9)
    assert masonry.limit(load(mended, TILT)).factor == pytest.approx(0.6, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "over", "suffix", "words"),
    [
        ("wall-tilted", {"contact.unit_unit.tan_friction_angle": 0.65, **TILT}, ".obj", ()),
        ("arch", {"contact.unit_unit.tan_friction_angle": 0.7, **PUSHED}, ".stl", ("--gap", "1 mm")),
    ],
)
def test_what_goes_out_as_surfaces_comes_back_with_the_same_factor(tmp_path, name, over, suffix, words):
    path = tmp_path / f"out{suffix}"
    assert main(["export", name, "--to", str(path)]) == 0
    back = load(imported(tmp_path, str(path), *words), over)
    there = load(name, {"limit": over["limit"]})
    (specimen, joints), (before, again) = joined(there), joined(back)
    assert np.sort(volumes(before.blocks)) == pytest.approx(np.sort(volumes(specimen.blocks)), rel=1e-9)
    assert len(again.patch_start) == len(joints.patch_start)
    assert again.area.sum() == pytest.approx(joints.area.sum(), rel=1e-9)
    assert masonry.limit(back).factor == pytest.approx(masonry.limit(there).factor, rel=1e-9)


@pytest.mark.parametrize(
    ("over", "said"),
    [
        ({"displacements": "large"}, "large displacement finds contacts where blocks touch"),
        ({"kinematics": "tets", "material.units.young_modulus": "1 GPa", "material.units.poisson_ratio": 0.2}, "tets"),
        ({"specimen.divisions": [2, 1, 1], "contact.within_units": WITHIN}, "divisions"),
        ({"floor": {}}, "hold the lowest blocks"),
    ],
)
def test_what_needs_blocks_that_meet_is_refused_where_gaps_are_bridged(wall, over, said):
    with pytest.raises(SceneError, match=said):
        joined(load(wall, over))


def test_a_specimen_that_is_turned_takes_its_joints_along(wall):
    turned = load(wall, {"specimen.turned": {"about": "z", "angle": "90 deg"}})
    joints, moved = joined(load(wall))[1], joined(turned)[1]
    assert moved.area.sum() == pytest.approx(joints.area.sum(), rel=1e-12)
    assert np.abs(moved.normal[:, 0]).max() == pytest.approx(0.0, abs=1e-12)  # head joints look along y now
    assert masonry.run(turned).summary["unbalanced_after_settling"] < 1e-9


def test_an_arch_in_seven_digits_has_the_factor_to_seven_digits(tmp_path):
    import trimesh

    there = load("arch", PUSHED)
    specimen, joints = joined(there)
    blocks, turn = specimen.blocks, rotation((0.0, 0.0, 1.0), 0.3)
    (tmp_path / "stl").mkdir()
    for b in range(blocks.count):
        faces = [blocks.face(f) @ turn.T for f in blocks.faces_of(b)]
        corner = np.concatenate([face[[0, k, k + 1]] for face in faces for k in range(1, len(face) - 1)])
        mesh = trimesh.Trimesh(corner, np.arange(len(corner)).reshape(-1, 3), process=False)
        mesh.export(tmp_path / "stl" / f"stone_{b}.stl")
    over = {
        "contact.unit_unit.tan_friction_angle": 0.7,
        **PUSHED,
        "specimen.turned": {"about": "z", "angle": "-0.3 rad"},
    }
    for words in ((), ("--gap", "1 mm")):
        back = load(imported(tmp_path, str(tmp_path / "stl"), *words, "--overwrite"), over)
        assert joined(back)[1].area.sum() == pytest.approx(joints.area.sum(), rel=1e-6)
        assert masonry.limit(back).factor == pytest.approx(masonry.limit(there).factor, rel=1e-5)


@pytest.mark.parametrize(("axis", "order"), [("x", (1, 2, 0)), ("y", (2, 0, 1)), ("z", (0, 1, 2))])
def test_the_axis_that_points_up_becomes_z(tmp_path, axis, order):
    imported(tmp_path, "wall.obj", "--up", axis)
    size = np.array([5.1, 0.5, 1.75])
    specimen = load_blocks(tmp_path / "new.blocks.h5")[0]
    assert np.ptp(specimen.blocks.points, axis=0) == pytest.approx(size[list(order)])
    assert np.all(volumes(specimen.blocks) > 0)


def test_what_was_mended_is_listed(tmp_path, capsys):
    imported(tmp_path, "wall.obj", "--gap", "25 mm")
    said = capsys.readouterr().out
    assert "joints   91 polygons, 18.5 m^2" in said and "in 31 they are up to 25 mm apart, 25 mm on average" in said
    assert "taken as 1 m" in said
    path = obj(tmp_path / "a.obj", corners(), corners((2, 0, 0)), faces=CUBE[:5])
    imported(tmp_path, str(path), "--holes", "2 m")
    said = " ".join(capsys.readouterr().out.split())
    assert "2 blocks have none: 'body0', 'body1'; --gap LENGTH" in said
    assert "holes that were closed, of up to 1.41e+03 mm: 2" in said


def test_bad_words_and_files_are_refused(tmp_path, capsys):
    out = ("--out", tmp_path / "x.toml")
    assert "does not exist" in complaint(capsys, "import", tmp_path / "no.obj", *out)
    (tmp_path / "empty.obj").write_bytes(b"")
    assert "is empty" in complaint(capsys, "import", tmp_path / "empty.obj", *out)
    (tmp_path / "folder").mkdir()
    assert "holds no .obj" in complaint(capsys, "import", tmp_path / "folder", *out)
    far = obj(tmp_path / "far.obj", corners(), corners((2, 0, 0)))
    assert "no two blocks are so near" in complaint(capsys, "import", far, "--gap", "1 mm", *out)
    assert "allowed: x, y, z" in complaint(capsys, "import", "wall.obj", "--up", "w", *out)
    assert "--angle" in complaint(capsys, "import", "wall.obj", "--gap", "1mm", "--angle", "90 deg", *out)
    deep = obj(tmp_path / "deep.obj", corners(), corners((0.5, 0, 0)))
    assert "overlap by no more than 0.1 mm (--tolerance)" in complaint(capsys, "import", deep, "--gap", "1 mm", *out)
    assert "overlap by 500 mm" in complaint(capsys, "import", deep, *out)
    holed = obj(tmp_path / "holed.obj", corners(), faces=CUBE[:5])
    assert "by --holes" in complaint(capsys, "import", holed, *out)
    assert not (tmp_path / "x.toml").exists()


@pytest.mark.slow
@pytest.mark.parametrize("data", DATA_SETS, ids=lambda data: data.name)
def test_the_data_sets_are_imported_and_stand(tmp_path, data):
    path = imported(tmp_path, data.name, *data.options)
    specimen, joints = joined(load(path))
    count, volume, polygons = COUNTS[data.name]
    assert specimen.blocks.count == count and volumes(specimen.blocks).sum() == pytest.approx(volume, rel=1e-9)
    assert len(joints.patch_start) - 1 == polygons
    assert masonry.run(load(path)).summary["unbalanced_after_settling"] < 1e-9
    assert masonry.limit(load(path, TILT)).factor == pytest.approx(TILTS[data.name], rel=1e-3)


def test_what_a_refusal_names_leads_past_it(tmp_path, capsys):
    """Overlaps and gaps at once, in one list; each way that is named works, and where none does none is named."""
    row = [corners((0, 0, 0)), corners((0.9995, 0, 0)), corners((0, 0, 1.0006)), corners((0, 1.0003, 0))]
    path, out = obj(tmp_path / "row.obj", *row), ("--out", tmp_path / "new.toml")
    said = complaint(capsys, "import", path, *out)
    assert said.count("'body0' and ") == 3 and "overlap of 0.5 mm" in said and "gap of 0.6 mm" in said
    ways = said.split("tried: ")[1].split(", or ")
    assert len(ways) == 2 and ways[0].startswith("--tolerance 0.61mm mends them")
    for way in ways:
        words = way.split(" lays ")[0].split(" mends ")[0].replace("'", "")
        value = words.split("--tolerance ")[1]
        gap = ("--gap", words.split("--gap ")[1].split(" --")[0]) if "--gap" in words else ()
        imported(tmp_path, str(path), "--tolerance", value, *gap, "--overwrite")
    deep = obj(tmp_path / "deep.obj", corners(), corners((0.5, 0, 0)), corners((0, 0.7, 0)))
    said = complaint(capsys, "import", deep, *out, "--overwrite")
    assert said.count("parts them") == 3 and "tried" not in said and "mend it where it was made" in said


def test_the_section_says_what_it_is_and_a_lone_body_that_nothing_can_open(tmp_path, capsys):
    imported(tmp_path, str(obj(tmp_path / "one.obj", corners())))
    said = capsys.readouterr().out
    assert "1 m^2: the area of the faces in the lowest plane" in said and "nothing can open" in said
    turn = rotation((0.0, 1.0, 0.0), 0.3)
    imported(tmp_path, str(obj(tmp_path / "two.obj", *(corners((k, 0, 0)) @ turn.T for k in (0, 1)))), "--overwrite")
    said = capsys.readouterr().out
    assert "the box round all, seen from above" in said and "nothing can open" not in said
    assert "the box round all" in (tmp_path / "new.toml").read_text()
