"""A result has the properties of its joints as numbers, and knows without them which joints without strength moved."""

from dataclasses import replace

import numpy as np

import masonry
from masonry.results.dry_joints import moved_undamaged
from masonry.scene import load
from tests.results.sample import sample

STIFFNESS = 'normal_stiffness = "30 GPa/m"\nshear_stiffness = "12 GPa/m"\n'


def test_joints_that_only_the_default_describes_are_seen_to_move_in_a_result_without_numbers():
    older = sample(damaged=False)
    frame = older.history.frames[-1]
    expected = np.hypot(frame.opening, frame.slip) > 0.0
    for name in ("unit_unit", "default"):
        result = replace(older, scene_toml=f"[contact.{name}]\n{STIFFNESS}")
        assert np.array_equal(moved_undamaged(result, frame), expected) and expected.any()


def test_the_properties_by_group_are_kept_in_the_folder_and_need_no_scene(tmp_path):
    scene = load("couplet", {"drive.steps": 20, "settle.steps": 10, "solver.rows": 2})
    result = masonry.run(scene)
    result.save(tmp_path)
    contact, loaded = scene.contact_of("unit_unit"), masonry.load_result(tmp_path)
    for one in (result, loaded):
        assert one.joint_properties["normal_stiffness"] == contact.normal_stiffness
        assert one.joint_properties["tensile_strength"] == contact.tensile_strength
        assert np.isnan(one.joint_properties["tan_dilation"]).all()
    whole = np.zeros(len(loaded.joints.area))
    lifted = replace(loaded.history.frames[-1], opening=whole + 1e-3, damage_tension=whole, damage_shear=whole)
    assert moved_undamaged(replace(loaded, scene_toml=""), lifted).all(), "by the numbers"
    assert moved_undamaged(replace(loaded, joint_properties={}), lifted).all(), "an older result, by its scene"
