"""Slabs that rest on a specimen."""

import pytest

import masonry
from geometry.blocks import GeometryError
from masonry.assembly.assemble import fabric_of
from masonry.errors import SceneError

SLAB = {"name": "roof", "origin": ["0 m", "0 m", "2.4 m"], "size": ["3 m", "1 m", "200 mm"]}
TABLES = {
    "material.slabs": {"density": "1000 kg/m^3"},
    "contact.slabs_units": {"normal_stiffness": "10 GPa/m", "shear_stiffness": "4 GPa/m", "tan_friction_angle": 0.5},
}


def test_a_slab_is_a_block_and_a_set_with_joints_of_its_own():
    fabric = fabric_of(masonry.load("wall-tied", {"specimen.slab": [SLAB], **TABLES}))
    blocks, joints = fabric.specimen.blocks, fabric.joints
    assert fabric.specimen.sets["roof"].tolist() == fabric.specimen.sets["slabs"].tolist() == [blocks.count - 1]
    of_slab = (joints.block_a == blocks.count - 1) | (joints.block_b == blocks.count - 1)
    assert joints.area[of_slab].sum() == pytest.approx(3.0 * 0.3)
    assert "slabs_units" in fabric.contact_groups


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"name": "top course"}, "there is a set 'top course' already"),
        ({"origin": ["0 m", "0 m", "2.3 m"]}, "overlap"),
    ],
)
def test_a_slab_has_a_name_and_a_place_of_its_own(change, said):
    with pytest.raises(GeometryError, match=said):
        fabric_of(masonry.load("wall-tied", {"specimen.slab": [SLAB | change], **TABLES}))


@pytest.mark.parametrize("name", ["all", "z = 0 mm", "blocks at z = 1 m", "a.z+", "roof + foot"])
@pytest.mark.parametrize("key", ["name", "group"])
def test_a_slab_is_not_called_as_a_selector(key, name):
    with pytest.raises(SceneError, match=rf"specimen\.slab\.0\.{key}.* reads as a selector"):
        masonry.load("wall-tied", {"specimen.slab": [SLAB | {key: name}], **TABLES})


@pytest.mark.parametrize("name", ["all", "z = 0 mm", "a.z+", "roof + foot"])
@pytest.mark.parametrize("key", ["name", "group"])
def test_a_box_is_not_called_as_a_selector(key, name):
    box = {"name": "foot", "origin": ["0 m"] * 3, "size": ["1 m"] * 3, key: name}
    with pytest.raises(SceneError, match=rf"specimen\.box\.0\.{key}.* reads as a selector"):
        masonry.load("wall-tied", {"specimen": {"kind": "boxes", "section": "1 m^2", "box": [box]}})


def test_a_check_says_what_bars_and_slabs_there_are():
    tied, house = masonry.check("wall-tied"), masonry.check("house-tilted")
    (bars,), (slab,) = tied.bars, house.slabs
    stiffness, force = 210e9 * 1.13e-4 / 2.0, 13.3e6 * 1.13e-4
    assert bars == (
        f"2 'tie', 2 m long, {stiffness / 1e6:.4g} MN/m, yields at {force:.4g} N, pulls; between blocks 28, 31 and "
        "fixed ends"
    )
    assert slab.startswith("'first floor', 4 x 4 x 0.2 m, 4800 kg, joints of ")
    assert tied.slabs == [] and bars in " ".join(str(tied).split())


def test_a_scene_without_slabs_says_nothing_of_them():
    assert "slab" not in masonry.load("wall-tied").resolved()["specimen"]
    assert "bar" not in masonry.load("wall-tilted").resolved()


def test_a_house_with_a_floor_bears_less_than_limit_analysis_with_dilation():
    limit = masonry.limit("house-tilted")
    assert limit.factor == pytest.approx(0.554688, rel=1e-5)
    assert limit.elements[0].force.max() == pytest.approx(2879.0, rel=1e-3)
