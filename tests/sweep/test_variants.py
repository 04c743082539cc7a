"""Which variants a scene gets: those that make sense for it, and no others."""

import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.scene import load
from masonry.sweeps.sensitivity.variants import KINDS, pace, variants
from tests.monitors.test_collision import slider
from tests.scenes import load as load_text


def settings(scene, kind):
    return [variant.settings for variant in variants(assemble(scene), [kind])[1:]]


def test_every_variant_of_a_wallette_is_named_once_and_its_scene_takes_it():
    scene = load("wallette-mode-1")
    chosen = variants(assemble(scene))
    assert chosen[0].name == "as it is" and chosen[0].settings == {}
    assert len({variant.name for variant in chosen}) == len(chosen) == 11
    assert {variant.kind for variant in chosen[1:]} == set(KINDS) - {"patches"}
    for variant in chosen[1:]:
        assert scene.with_(variant.settings) != scene


def test_points_of_patches_are_varied_where_dry_contacts_are_found_anew():
    other = {"specimen.patch_points": "corners"}
    assert settings(load("arch-tilted"), "patches") == [{"specimen.patch_points": "spread"}]
    assert settings(load("arch-tilted", {"specimen.patch_points": "spread"}), "patches") == [other]
    assert settings(load("block-rocking"), "patches") == [{"specimen.patch_points": "spread"}], "it meets a floor"
    assert settings(load("arch"), "patches") == []


def test_a_drive_to_an_accuracy_gets_a_finer_one_and_a_constant_rate():
    finer, rate = settings(load("couplet"), "pace")
    assert finer == {"drive.accuracy": pytest.approx(0.01 / 3)} and rate == {"drive.steps": 20000}
    assert settings(load("couplet"), "damping") == [{"drive.steps": 20000, "solver.damping": 0.4}]
    assemblies = [assemble(load("couplet", {"drive.accuracy": accuracy})) for accuracy in (2.97e-4, 3.03e-4)]
    made = [pace(assembly)[0].settings["drive.accuracy"] for assembly in assemblies]
    assert made == pytest.approx([3 * 2.97e-4, 1.01e-4]), "0.01 % is the finest that there is"


def test_a_drive_at_a_rate_gets_half_of_it_and_one_in_steps_twice_as_many():
    assert settings(load("couplet", {"drive.rate": "0.2 mm/s"}), "pace") == [{"drive.rate": "0.0001 m/s"}]
    in_steps = load("couplet", {"drive.steps": 500})
    assert settings(in_steps, "pace") == [{"drive.steps": 1000}]
    assert settings(in_steps, "damping") == [{"solver.damping": 0.4}, {"solver.damping": pytest.approx(0.9)}]
    assert settings(load("couplet", {"drive.steps": 500, "solver.damping": 0}), "damping") == []


def test_options_of_the_contacts_are_set_where_groups_have_another_one_and_the_strength_for_it():
    mixed = {"contact.unit_unit.coupling": "independent"}
    two = settings(load("wallette-mode-1", mixed), "coupling")
    assert [set(given.values()) for given in two] == [{"combined"}, {"independent"}]
    assert all(set(given) == {"contact.unit_unit.coupling", "contact.within_units.coupling"} for given in two)
    dry = load_text(slider(1.0))  # brittle, without strength: nothing that unloads or softens
    assert [settings(dry, kind) for kind in ("coupling", "unloading", "softening")] == [[], [], []]


def test_kinematics_change_where_blocks_are_free_and_only_to_what_the_scene_has_numbers_for():
    assert settings(load("wallette-mode-1"), "kinematics") == [{"kinematics.units": "affine"}]  # no mesh_size, no tets
    assert [list(s.values()) for s in settings(load("couplet", {"kinematics": "affine"}), "kinematics")] == [
        ["rigid"],
        ["tets"],
    ]


def test_the_floor_of_a_scene_stays_what_it_is():
    scene = load("couplet-slid-off")
    names = [variant.name for variant in variants(assemble(scene))]
    assert names[:3] == ["as it is", "half the rate", "coupling independent"]
    assert settings(scene, "softening") == [{"contact.unit_unit.softening_variable": "plastic"}]  # friction has none
    (slower,) = settings(scene, "pace")
    assert slower == {"drive.rate": "0.05 m/s", "solver.duration": "10.0 s"}
    assert assemble(scene.with_(slower)).plan.steps > assemble(scene).plan.steps, "or it would be refused"
    deformable = {"material.units.young_modulus": "16.7 GPa", "material.units.poisson_ratio": 0.15}
    assert settings(scene.with_(deformable), "kinematics") == [{"kinematics.units": "affine"}]


def test_plates_turn_or_do_not_where_they_are_rigid_and_not_held_altogether():
    assert settings(load("wallette-mode-1"), "plates") == [{"support.1.fix": ["y"]}]
    hinged = load("wallette-mode-1", {"support.1.fix": ["y"]})
    assert settings(hinged, "plates") == [{"support.1.fix": ["y", "rotation"]}]
    assert settings(load("wallette-mode-1", {"kinematics.plates": "affine"}), "plates") == []
    assert settings(load("couplet"), "plates") == []
    assert settings(load("shear-wall"), "plates") == [{"support.1.fix": ["y"]}]


def test_cells_get_other_seeds_and_a_grid_gets_cells():
    assert [s["specimen.cells.seed"] for s in settings(load("wallette-mode-1-218"), "cells")] == [2, 3]
    assert [s["specimen.mortar.cells.seed"] for s in settings(load("couplet-meso-coarse"), "cells")] == [2, 3]
    grid = settings(load("wallette-mode-1"), "cells")
    assert grid == [{"specimen.cells.total": 256, "specimen.cells.seed": seed} for seed in (1, 2)]
    assert settings(load("couplet"), "cells") == []  # its units are whole


def test_only_some_kinds_and_quick():
    assembly = assemble(load("wallette-mode-1"))
    assert {v.kind for v in variants(assembly, ["plates", "pace"])} == {"base", "plates", "pace"}
    quick = variants(assembly, quick=True)
    assert len({v.kind for v in quick}) == len(quick) and not {"cells", "kinematics"} & {v.kind for v in quick}
    assert [v.kind for v in variants(assembly, ["cells"], quick=True)] == ["base", "cells"]
    with pytest.raises(SceneError, match="--only paces: no such kind of variant; known here: .*did you mean 'pace'"):
        variants(assembly, ["paces"])
