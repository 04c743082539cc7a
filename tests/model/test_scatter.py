"""Runs whose joints differ in strength: their ledger, their limits, and what they come to as the scatter vanishes."""

import numpy as np
import pytest

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.configuration.energy import Seen
from masonry.errors import Stopped
from masonry.laboratory import laboratory
from masonry.loading.drive.utilisation import utilisation
from masonry.monitors.snap_back_watch import SnapBack

STRENGTHS = ("tensile_strength", "cohesion", "fracture_energy_mode_1", "fracture_energy_mode_2")
SMALL = {"specimen.divisions": [2, 1]}


def scatter(variation: float, *groups: str, seed: int = 1) -> dict[str, float]:
    return {"scatter.seed": seed, **{f"scatter.{g}.{key}": variation for g in groups for key in STRENGTHS}}


def run(name: str, threads: int = 1, **changes):
    return laboratory.run(scene.load(name, changes), threads)


def test_as_the_scatter_vanishes_the_run_comes_to_the_one_without():
    plain = run("wallette-mode-2", **SMALL).summary
    nearly = run("wallette-mode-2", **SMALL, **scatter(1e-9, "unit_unit", "within_units")).summary
    assert nearly["peak_stress_pa"] == pytest.approx(plain["peak_stress_pa"], rel=1e-7)
    assert nearly["energy_j"]["fracture_mode_1"] == pytest.approx(plain["energy_j"]["fracture_mode_1"], rel=1e-6)


def test_no_variation_at_all_is_the_run_without_bit_by_bit():
    plain, none = run("wallette-mode-2", **SMALL), run("wallette-mode-2", **SMALL, **scatter(0.0, "unit_unit"))
    assert all(np.array_equal(plain.history.rows[key], none.history.rows[key]) for key in plain.history.rows)


def test_the_energy_balance_closes_and_the_laws_book_what_the_contacts_took():
    summary = run("wallette-mode-2", **SMALL, **scatter(0.2, "unit_unit", "within_units")).summary
    assert summary["energy_imbalance"] < 1e-10
    assert summary["dissipation_mismatch"] < 0.01
    assert set(summary["scatter"]) == {"unit_unit", "within_units"}
    assert summary["scatter"]["unit_unit"]["cohesion"]["draws"] == 18


@pytest.mark.slow
def test_on_two_threads_a_run_gives_the_bits_of_one():
    changes = {**SMALL, "drive.steps": 2000, **scatter(0.2, "unit_unit", "within_units")}
    one, two = (run("wallette-mode-2", threads, **changes) for threads in (1, 2))
    assert all(np.array_equal(one.history.rows[key], two.history.rows[key]) for key in one.history.rows)


def test_a_couplet_breaks_at_the_strength_that_its_joint_has_drawn():
    """In tension nothing else can give way: the peak is the drawn strength."""
    changes = {
        **{"confinement": "0 Pa", "traction.0.stress": {"z": "0 Pa"}, "drive.direction": "z"},
        **{"drive.displacement": "0.02 mm", "drive.steps": 4000, "support.1.fix": ["x", "y", "rotation"]},
    }
    summary = run("couplet", **changes, **scatter(0.5, "unit_unit")).summary
    drawn = summary["scatter"]["unit_unit"]["tensile_strength"]
    assert drawn["draws"] == 1 and abs(drawn["mean"] / 0.58e6 - 1.0) > 0.05
    assert summary["peak_stress_pa"] == pytest.approx(drawn["mean"], rel=0.01)


def test_each_contact_begins_with_the_elastic_limit_and_the_utilisation_of_its_own_strength():
    model = assemble(scene.load("wallette-mode-1", SMALL | scatter(0.5, "unit_unit"))).model
    g = model.group_names.index("unit_unit")
    own = slice(int(model.groups.bounds[g]), int(model.groups.bounds[g + 1]))
    joint = model.groups.properties[g]
    strength = joint.tensile_strength
    np.testing.assert_allclose(model.state.opening_max[own], strength / joint.normal_stiffness, rtol=1e-15)
    units = np.sort(model.blocks.unit[np.column_stack([model.joints.block_a, model.joints.block_b])[own]], axis=1)
    for pair in np.unique(units, axis=0):
        assert len(np.unique(strength[(units == pair).all(axis=1)])) == 1
    assert len(np.unique(strength)) == 18
    seen = Seen(*np.zeros((4, len(model.group))))
    seen.sigma[own] = 0.5 * strength.min()
    assert utilisation(model, seen, np.zeros(len(model.group))) == pytest.approx(0.5, rel=1e-12)


def test_snap_back_in_a_run_is_looked_for_with_the_energy_drawn_and_the_message_says_it():
    """Linear law: (c0 + sigma (tan0 - tan_res))^2 = 2 ks G_II, c0 and G_II of the joint that softens."""
    changes = {"law": "linear", "contact.unit_unit.tan_residual_friction_angle": 0.5}
    model = assemble(scene.load("wallette-mode-1", SMALL | changes | scatter(0.3, "unit_unit"))).model
    g = model.group_names.index("unit_unit")
    parameters, joint = model.groups.parameters[g], model.groups.properties[g]
    first, count = int(model.groups.bounds[g]), len(parameters.G_II)
    limit = (np.sqrt(2.0 * joint.shear_stiffness * parameters.G_II) - joint.cohesion) / (joint.tan_friction - 0.5)
    worst = int(np.argmin(limit))
    for share, c in ((0.99, worst), (1.01, worst)):
        watch = SnapBack(model)
        normal, area, force = model.contacts.normal, model.contacts.area, model.contacts.force
        force[first + c] = -share * limit[c] * area[first + c] * normal[first + c]
        model.state.intact_s[first + c] -= 0.1
        if share < 1.0:
            watch.check(7)
        else:
            with pytest.raises(Stopped, match=f"contact {first + c} .*drawn here: {parameters.G_II[c]:.4g} N/m"):
                watch.check(7)
    assert count > len(np.unique(limit)) > 2
