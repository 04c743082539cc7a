"""Solids of STEP files as blocks: volumes, names, colours, units, joints; and files that are no good."""

import math
import re

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.files.sandbox import guarded
from geometry.files.step_labels import labels
from geometry.files.step_reader import length_unit, records
from geometry.joints.find import find_joints
from geometry.joints.heal import mend
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.overlaps import check_overlaps
from tests.geometry.files import step_files as files


def read(path, **words):
    return guarded("geometry.files.cad", "read_cad", path, **words)


def refused(path, **words):
    with pytest.raises(GeometryError) as error:
        read(path, **words)
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.fixture(scope="module")
def wall(tmp_path_factory):
    path = tmp_path_factory.mktemp("step") / "wall.step"
    orange = {"brick-0-1": (0.75, 0.25, 0.125)}
    return files.write_step(path, files.wall(4, 3), files.wall_names(4, 3), orange)


def test_a_wall_comes_in_with_volumes_names_colours_and_joints(wall):
    solids = read(wall)
    assert solids.names == tuple(files.wall_names(4, 3))
    assert volumes(solids.blocks) == pytest.approx(np.full(12, 0.25 * 0.12 * 0.06), rel=1e-12)
    assert np.diff(solids.blocks.block_face_start).tolist() == [6] * 12
    assert solids.colours[1].tolist() == [0.75, 0.25, 0.125] and np.isnan(solids.colours[0]).all()
    low, _ = bounds(solids.blocks)
    assert low[4] == pytest.approx([0.125, 0, 0.06], abs=1e-12)
    check_overlaps(solids.blocks)
    joints = find_joints(solids.blocks)
    assert joints.area.sum() == pytest.approx(files.wall_joint_area(4, 3), rel=1e-9)
    assert solids.notes == ()


def test_inches_are_read_as_such_and_overruled_on_demand(tmp_path):
    path = files.write_step(tmp_path / "wall.step", files.wall(2, 2, 0, 0.04), files.wall_names(2, 2), inch=True)
    inch = read(path)
    assert volumes(inch.blocks) == pytest.approx(np.full(4, 10 * 4.8 * 2.4 * 0.0254**3), rel=1e-9)
    assert inch.names[3] == "brick-1-1"
    metre = read(path, unit=1.0)
    assert volumes(metre.blocks) == pytest.approx(np.full(4, 10 * 4.8 * 2.4), rel=1e-9)
    assert "0.0254 m" in metre.notes[0]


def test_an_arch_of_wedges_has_plane_joints(tmp_path):
    solids = read(files.write_step(tmp_path / "arch.step", files.arch(9), [f"v{k}" for k in range(9)]))
    wedge = (1.25**2 - 1.0**2) / 2 * math.sin(math.pi / 9) * 0.2
    assert volumes(solids.blocks) == pytest.approx(np.full(9, wedge), rel=1e-9)
    joints = find_joints(mend(solids.blocks, 1e-4, solids.names).blocks)
    assert joints.area.sum() == pytest.approx(8 * 0.25 * 0.2, rel=1e-9)
    assert len(np.unique(joints.patch)) == 8


def test_a_perforated_unit_is_one_block_and_its_joint_leaves_out_the_holes(tmp_path):
    path = files.write_step(tmp_path / "perforated.step", files.perforated(2), ["lower", "upper"])
    coarse, fine = read(path), read(path, facet=2e-5)
    exact = 0.25 * 0.12 - 2 * 0.04**2 - math.pi * 0.015**2
    for solids, error in ((coarse, 1e-3), (fine, 1e-4)):
        assert solids.blocks.count == 2
        assert volumes(solids.blocks) == pytest.approx(np.full(2, exact * 0.06), rel=error)
        joints = find_joints(solids.blocks)
        assert joints.area.sum() == pytest.approx(volumes(solids.blocks)[0] / 0.06, rel=1e-9)
        check_overlaps(solids.blocks)
        assert "2 solids have curved faces" in solids.notes[0]
    said = float(re.search(r"volume by ([-+.e\d]+) in all", coarse.notes[0])[1])
    assert said == pytest.approx(volumes(coarse.blocks)[0] / (exact * 0.06) - 1, rel=0.01)


def test_curved_solids_keep_their_volume_within_the_facets(tmp_path):
    def build(occ):
        occ.addCone(0, 0, 0, 0, 0, 50, 20, 0)
        occ.addTorus(200, 0, 0, 50, 10)
        occ.addSphere(400, 0, 0, 30)
        occ.cut([(3, occ.addBox(600, 0, 0, 100, 100, 100))], [(3, occ.addBox(620, 20, 20, 10, 10, 10))])

    solids = read(files.write_step(tmp_path / "curved.step", build, ["cone", "torus", "ball", "hollow"]), facet=2e-5)
    exact = [math.pi * 400 * 50 / 3, 2 * math.pi**2 * 50 * 100, 4 / 3 * math.pi * 30**3, 1e6 - 1e3]
    assert volumes(solids.blocks) == pytest.approx(1e-9 * np.array(exact), rel=2e-3)
    assert volumes(solids.blocks)[3] == pytest.approx(1e-9 * exact[3], rel=1e-12)
    assert solids.names == ("cone", "torus", "ball", "hollow")


@pytest.mark.parametrize("gap", [0.05, -0.05])
def test_gaps_and_overlaps_of_a_twentieth_of_a_millimetre_are_mended(tmp_path, gap):
    solids = read(files.write_step(tmp_path / "wall.step", files.wall(4, 3, gap), files.wall_names(4, 3)))
    mended = mend(solids.blocks, 1e-4, solids.names)
    assert len(mended.gaps.size) == 9
    assert mended.gaps.size == pytest.approx(np.full(9, gap * 1e-3), rel=1e-6)
    assert np.abs(mended.volume_change).max() == pytest.approx(0.05 / 250, rel=1e-3)
    joints = find_joints(mended.blocks)
    assert joints.area.sum() == pytest.approx(files.wall_joint_area(4, 3), rel=1e-4)
    assert len(np.unique(joints.patch)) == 9 + 14
    check_overlaps(mended.blocks)


def test_solids_that_are_put_into_an_assembly_have_the_names_of_their_use(tmp_path):
    path = files.write_step(tmp_path / "one.step", files.wall(1, 1), ["brick"])
    product = "'Open CASCADE STEP translator 7.8 1'"
    text = re.sub(r"'Open CASCADE STEP translator [\d. ]+'", product, path.read_text()).replace(product, "'stone'")
    path.write_text(text)
    assert read(path).names == ("stone",)


def test_names_follow_the_solids_to_their_places_in_an_assembly(tmp_path):
    """Every part is turned a quarter about z and moved up by as much as its number: names must not be mixed up."""
    path = files.write_step(tmp_path / "wall.step", files.wall(5, 1), [f"unit {k}" for k in range(5)])
    text = path.read_text()
    place = re.findall(r"ITEM_DEFINED_TRANSFORMATION\('','',#\d+,#(\d+)\)", text)
    assert len(place) == 5
    for k, number in enumerate(place):
        origin, axis, across = re.search(rf"#{number} = AXIS2_PLACEMENT_3D\('',#(\d+),#(\d+),#(\d+)\)", text).groups()
        text = re.sub(rf"#{origin} = .*;", f"#{origin} = CARTESIAN_POINT('',(0.,0.,{100 * k}.));", text)
        text = re.sub(rf"#{axis} = .*;", f"#{axis} = DIRECTION('',(0.,0.,1.));", text)
        text = re.sub(rf"#{across} = .*;", f"#{across} = DIRECTION('',(0.,1.,0.));", text)
    path.write_text(text)
    solids = read(path)
    low, high = bounds(solids.blocks)
    for b, name in enumerate(solids.names):
        k = int(name.split()[-1])
        assert low[b] == pytest.approx([-0.12, 0.25 * k, 0.1 * k], abs=1e-12)
        assert high[b] == pytest.approx([0, 0.25 * (k + 1), 0.1 * k + 0.06], abs=1e-12)
    assert sorted(solids.names) == [f"unit {k}" for k in range(5)]


def test_unreadable_files_end_in_one_message(wall, tmp_path):
    text = wall.read_text()

    def written(name, content):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    assert "empty" in refused(written("empty.step", b""))
    assert "damaged" in refused(written("torn.step", text[: len(text) // 3]))
    assert "no STEP file" in refused(written("noise.step", np.random.default_rng(1).bytes(100_000)))
    assert "lost: brick-" in refused(written("holes.step", re.sub(r"#1(\d*) = VERTEX_POINT", "#9 = NOTHING", text)))
    refused(written("far.step", text.replace("250.", "1.E400")))
    refused(written("torn.brep", text[:1000]))
    refused(written("torn.iges", text[:1000]))
    assert "exist" in refused(tmp_path / "missing.step")
    huge = written("huge.step", b"ISO-10303-21;")
    with huge.open("r+b") as stream:
        stream.truncate(600_000_000)
    assert "at most" in refused(huge)


def test_a_reader_that_crashes_loops_or_eats_memory_is_stopped(monkeypatch, tmp_path):
    path = tmp_path / "any.txt"
    path.write_text("x")
    with pytest.raises(GeometryError, match="crashed on it .SIGSEGV"):
        guarded("tests.geometry.files.bad_readers", "crash", path)
    with pytest.raises(GeometryError, match="GB of memory"):
        guarded("tests.geometry.files.bad_readers", "eat", path)
    with pytest.raises(GeometryError, match="ValueError: no such thing"):
        guarded("tests.geometry.files.bad_readers", "trip", path)
    monkeypatch.setattr("geometry.files.sandbox.START", 1)
    with pytest.raises(GeometryError, match="more than 1 s of processor time"):
        guarded("tests.geometry.files.bad_readers", "loop", path)
    monkeypatch.setattr("geometry.files.sandbox.SECONDS", 2)
    with pytest.raises(GeometryError, match="after 2 s"):
        guarded("tests.geometry.files.bad_readers", "sleep", path)


def test_assemblies_that_hold_themselves_and_multiply_come_to_an_end():
    lines = ["#1 = PRODUCT_DEFINITION('','',#900,$);", "#2 = PRODUCT_DEFINITION('','',#900,$);"]
    lines += [f"#{10 + n} = NEXT_ASSEMBLY_USAGE_OCCURRENCE('{n}','','',#{1 + n % 2},#{2 - n % 2},$);" for n in range(8)]
    assert labels(records("\n".join(lines)), 1000) == []
    deep = [f"#{n} = PRODUCT_DEFINITION('','',#900,$);" for n in range(1, 40)]
    deep += [
        f"#{1000 + n} = NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#{n // 2 + 1},#{n // 2 + 2},$);" for n in range(70)
    ]
    assert labels(records("\n".join(deep)), 1000) == []


def test_strings_with_semicolons_quotes_and_comments_do_not_confuse_the_records():
    text = "/* #7 = A('x'); */ #1 = PRODUCT('a;b','it''s #5 /* no */','',(#2));\n#2=B((1.5,-2.E-3),#1);"
    entities = records(text)
    assert set(entities) == {1, 2} and entities[2][0] == "B"
    assert length_unit(records("#1 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) );")) == 1.0
