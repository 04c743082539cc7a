"""What of a scene is resolution, and what it sets."""

import pytest

from masonry.cli.main import main
from masonry.scene import changed, load
from masonry.sweeps.convergence.refinement.campaign import Campaign, merged
from masonry.sweeps.convergence.refinement.resolutions import jitter, not_refined, resolutions_of
from tests.convergence.samples import TIPPED


def settings(scene, name, factor=2.0):
    return next(r for r in resolutions_of(scene) if r.name == name).settings(factor)


@pytest.mark.parametrize(
    ("keys", "name", "expected"),
    [
        ({}, "pace", {"drive.accuracy": 0.005, "settle.steps": 8000}),
        ({"drive.steps": 3000}, "pace", {"drive.steps": 6000, "settle.steps": 8000}),
        ({"drive.rate": "4 mm/s"}, "pace", {"drive.rate": "0.002 m/s", "settle.steps": 8000}),
        (
            {"specimen.points_per_edge": {"x": 5, "y": 3, "z": 2}},
            "points along y",
            {"specimen.points_per_edge": {"x": 5, "y": 6, "z": 2}},
        ),
        ({"specimen.points_per_face": 7}, "points per face", {"specimen.points_per_face": 28}),
        ({"specimen.contact_spacing": "9 mm"}, "spacing of points", {"specimen.contact_spacing": "0.0045 m"}),
    ],
)
def test_a_setting_is_made_finer(keys, name, expected):
    scene = load("couplet", keys)
    assert settings(scene, name) == expected
    changed(scene, expected)


def test_tets_have_a_coarser_mesh_beside_the_finer_one():
    scene = load("couplet", {"kinematics": "tets", "specimen.mesh_size": "30 mm"})
    size = next(r for r in resolutions_of(scene) if r.name == "size of tets")
    assert size.factors[0] < 1.0 < size.factors[1]
    assert size.settings(1.5) == {"specimen.mesh_size": "0.02 m"}


def test_a_motion_has_its_time_step_and_no_pace():
    scene = load("block-rocking")
    assert settings(scene, "time step") == {"solver.step_fraction": scene.solver.step_fraction / 2, "solver.rows": 2000}
    assert "pace" not in [r.name for r in resolutions_of(scene)]


def test_a_step_that_is_given_is_divided_itself():
    scene = load("block-rocking", {"solver.time_step": "2e-5 s"})
    assert settings(scene, "time step") == {"solver.time_step": "1e-05 s", "solver.rows": 2000}
    changed(scene, settings(scene, "time step"))


def test_an_accuracy_ends_at_the_finest_that_there_is():
    assert settings(load("couplet", {"drive.accuracy": 1.5e-4}), "pace") is None


def test_what_differs_in_nothing_differs_by_a_hundredth():
    scene = load("couplet")
    assert jitter(scene, 1.01)["drive.accuracy"] == pytest.approx(0.01, rel=0.011)
    assert jitter(scene, 1.01)["solver.step_fraction"] != scene.solver.step_fraction


def test_points_of_drums_are_refined_along_all_edges_together():
    """The fewest along two axes count in a polygon: one alone changes nothing."""
    names = [r.name for r in Campaign(load("column-pushed", {"specimen.sides": 6})).resolutions]
    assert "points along all edges" in names and "points along x" not in names


def test_runs_cost_no_more_than_is_allowed():
    """Of tets both the coarser and the finer mesh, where it reaches; the cheaper in any case."""
    scene = load("couplet", {"kinematics": "tets"})
    for cost, sizes in {1.0: 1, 100.0: 2}.items():
        trials = Campaign(scene, cost).first()
        names = [trial.name for trial in trials]
        assert names[:2] == ["as it is", "scatter"] and names.count("size of tets") == sizes
        assert "pace" in names
    size = next(trial for trial in Campaign(scene, 1.0).first() if trial.name == "size of tets")
    assert size.factor < 1.0 and size.cost < 1.0


def test_rounds_after_the_first_cost_no_more_than_is_left():
    campaign = Campaign(load(TIPPED), 6.0)
    changes = {"points along x": 0.2, "pace": 0.1}
    assert [trial.name for trial in campaign.second(campaign.first(), changes, 0.0, 2.0)] == [
        "together",
        "points along x",
    ]
    assert campaign.second(campaign.first(), changes, 0.0, 5.9) == []


def test_few_points_from_edge_to_edge_are_made_four_times_as_many_and_again_where_nothing_moves():
    """Two and four of them bear alike where a block turns about its edge."""
    campaign = Campaign(load(TIPPED, {"specimen.contact_points": "vertex", "specimen.points_per_edge": 2}), 20.0)
    (along,) = [trial for trial in campaign.first() if trial.name == "points along x"]
    assert along.settings["specimen.points_per_edge"]["x"] == along.at_edges == 8
    (again,) = campaign.second(campaign.first(), {}, 0.0, 3.0)
    assert (again.name, again.at_edges) == ("points along x", 16)
    finer = Campaign(load(TIPPED, {"specimen.contact_points": "vertex", "specimen.points_per_edge": 5})).first()
    assert [trial.at_edges for trial in finer if trial.name == "points along x"] == [10]
    inside = Campaign(load(TIPPED, {"specimen.points_per_edge": 2})).first()
    assert [trial.factor for trial in inside if trial.name == "points along x"] == [2.0]
    assert all(trial.at_edges is None for trial in inside)


def test_all_together_have_the_most_points_of_each():
    first = {"specimen.points_per_edge": {"x": 6, "y": 3, "z": 3}, "drive.accuracy": 0.005}
    second = {"specimen.points_per_edge": {"x": 3, "y": 3, "z": 6}}
    assert merged(first, second) == first | {"specimen.points_per_edge": {"x": 6, "y": 3, "z": 6}}


def test_divisions_are_part_of_the_model_and_told_so():
    assert "where cracks may run" in " ".join(not_refined(load("couplet", {"specimen.divisions": [2, 1, 2]})))
    assert not_refined(load("wallette-mode-1-218")) == not_refined(load(TIPPED)) == []


def test_scatter_is_looked_at_again_where_nothing_else_shows():
    campaign = Campaign(load(TIPPED))
    again = campaign.second(campaign.first(), {"pace": 1e-4}, 1e-3, 3.0)
    assert [trial.name for trial in again] == ["scatter"]
    assert campaign.second(campaign.first(), {"pace": 1e-4}, 1e-3, 5.5) == []


def test_rows_of_a_motion_go_with_its_step_but_for_those_that_are_the_band_of_an_acceleration():
    scene = load("block-shaken")
    assert settings(scene, "time step")["solver.sampling"] == f"{2 * scene.sampling!r} Hz"
    head = {"name": "sway", "at": "top", "direction": "x", "quantity": "acceleration"}
    assert list(settings(load("block-shaken", {"gauge": [head]}), "time step")) == ["solver.step_fraction"]


def test_a_load_that_grows_has_the_accuracy_of_its_trials():
    assert settings(load("wall-tilted"), "trials") == {"limit.accuracy": 0.0025}
    assert settings(load("wall-tilted", {"limit.accuracy": 1.5e-4}), "trials") is None
    trials = next(r for r in resolutions_of(load("wall-tilted")) if r.name == "trials")
    assert trials.settings(0.5) is None  # the interval of its factor would be twice as wide
    assert "trials" not in [r.name for r in resolutions_of(load("couplet"))]


@pytest.mark.parametrize(
    ("name", "keys", "expected"),
    [
        ("arch-tilted", {}, {"points of patches"}),
        ("arch-tilted", {"specimen.patch_points": "spread"}, set()),
        ("couplet-slid-off", {}, {"points along x", "points along y", "points of patches"}),
    ],
)
def test_dry_joints_in_large_displacement_have_points_of_patches_alone(name, keys, expected):
    """Points of joints are those of bonds; a bond that breaks leaves a patch."""
    scene = load(name, keys)
    assert {r.name for r in Campaign(scene).resolutions} - {"time step"} == expected
    chosen = "patch_points_per_edge in its place" in " ".join(not_refined(scene))
    assert chosen == ("specimen.patch_points" in keys)


def test_points_of_patches_are_doubled_from_those_of_the_program():
    assert settings(load("arch-tilted"), "points of patches") == {"specimen.patch_points_per_edge": 4}


def test_a_limit_analysis_has_nothing_to_refine_and_says_so_in_a_line(capsys):
    """Rigid blocks and the corners of their joints: its factor is an optimum, and no run of a scene has it."""
    (said,) = not_refined(load("arch-own-weight"))
    assert "masonry limit has nothing to refine" in said and not_refined(load("wall-tilted")) == []
    assert main(["converge", "arch-own-weight", "--of", "limit.factor"]) == 2
    err = capsys.readouterr().err
    assert "nothing to refine" in err and err.count("\n") == 1
