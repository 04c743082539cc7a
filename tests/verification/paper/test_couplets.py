"""What is read off couplets, and the claims on it, held against curves that are known."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from masonry import scene
from verification.paper import page
from verification.paper.catalogue import catalogue
from verification.paper.couplets import beds, cells, energies, laws, measures, mortar, printed
from verification.paper.couplets.laws import CONFINEMENTS, LAWS, joint, name
from verification.paper.experiment import Claim, Done, Section, Shown
from verification.references.closed_forms import Joint, dissipated_in_shear, shear, shear_area, shear_work

SLIP = np.linspace(0.0, 1e-3, 20001)
AREA = 0.01


def result(stress: np.ndarray, mode_2: float = 0.0) -> SimpleNamespace:
    """A run with this curve (Pa over SLIP), its peak and its energy of mode II (J)."""
    rows = {"displacement": SLIP, "stress": stress}
    summary = {
        "peak_stress_pa": float(stress.max()),
        "final_stress_pa": float(stress[-1]),
        "section_m2": AREA,
        "energy_j": {"fracture_mode_2": mode_2},
    }
    return SimpleNamespace(history=SimpleNamespace(rows=rows), summary=summary)


def exact(law: str, confinement: str) -> SimpleNamespace:
    """The run that the closed form would give."""
    one, s = joint(confinement), CONFINEMENTS[confinement]
    stress = shear(law, one, SLIP, s)
    slid = SLIP[-1] - stress[-1] / one.ks
    mode_2 = AREA * (float(dissipated_in_shear(law, one, SLIP[-1], s)) - float(one.residual(s)) * slid)
    return result(stress, mode_2)


def done(results: dict) -> Done:
    """These results as if they had been run."""
    rows = {label: {"status": "OK"} for label in results}
    return Done(results, rows, Path(), loaded=dict(results))


@pytest.fixture
def joints() -> Done:
    return done({name(law, c): exact(law, c) for law in LAWS for c in CONFINEMENTS})


def test_the_line_through_exact_peaks_has_the_cohesion_and_the_friction_that_made_them():
    sigma = np.array(list(CONFINEMENTS.values()))
    assert measures.strength_line(sigma, Joint().peak(sigma)) == pytest.approx((0.87e6, 1.01), rel=1e-9)


def test_work_stiffness_and_plateau_are_those_of_the_closed_form():
    rows = exact("linear", "0.5 MPa").history.rows
    assert measures.work_to(rows, 0.3e-3) == pytest.approx(
        float(shear_work("linear", Joint(), 0.3e-3, 0.5e6)), rel=1e-4
    )
    assert measures.initial_stiffness(rows) == pytest.approx(Joint().ks, rel=1e-9)
    assert measures.plateau(rows) == pytest.approx(0.365e6, rel=1e-9)


def test_lambda_as_printed_starts_near_nothing_and_grows_where_the_mended_one_starts_at_one_and_falls():
    one = Joint(beta=2.1)
    slip = np.linspace(float(one.peak(1e5)) / one.ks, 1e-3, 50)
    shown, mended = printed.intact_fraction(one, slip, 1e5), printed.mended_fraction(one, slip, 1e5)
    assert shown[0] < 0.01
    assert np.all(np.diff(shown) > 0.0)
    assert mended[0] == pytest.approx(1.0)
    assert np.all(np.diff(mended) < 0.0)


def test_misprints_are_listed_with_what_they_come_to_and_are_no_claims():
    misprints = {m.where: m for m in printed.misprints()}
    assert "45, -7, -72 N/m" in misprints["4, Table 1"].comes_to
    assert "0.281 MPa are left" in misprints["3, eq. (17)"].comes_to
    section = Section([], [Claim("a", "1", "x", "0", True)], misprints=printed.misprints())
    shown = [Shown(catalogue()["couplet"], section, [], 1.0, 1)]
    assert "Misprints: 6" in "".join(page.tables(shown))
    assert "Of 1 claims 1 hold" in page.verdict(shown).sentence


def test_a_bed_is_a_multiple_of_the_interfaces_in_strength_and_energy_and_the_shipped_one_is_four():
    shipped = scene.load("couplet-meso-coarse").contact
    assert scene.load("couplet-meso-coarse", beds.bed(beds.SHIPPED)).contact == shipped
    alike = scene.load("couplet-meso-coarse", beds.bed(1)).contact
    assert alike["within_mortar"] == alike["unit_mortar"]


def test_the_cohesion_of_the_printed_exponent_solves_its_own_equation():
    one, slip = Joint(), 0.3e-3
    c = printed.fading_cohesion(one, slip, 1e5)
    past = slip - float(one.peak(1e5)) / one.ks
    assert c == pytest.approx(one.c0 * np.exp(-c * past / float(one.mode_2_energy(1e5))), rel=1e-9)


def test_the_beta_nearest_to_an_exponential_curve_gives_a_smaller_miss_than_its_neighbours():
    beta, u = laws.nearest_beta("1.0 MPa"), np.linspace(0.0, 0.8e-3, 2001)

    def miss(value: float) -> float:
        return float(
            np.sum((shear("polynomial", Joint(beta=value), u, 1e6) - shear("exponential", Joint(), u, 1e6)) ** 2)
        )

    assert miss(beta) < min(miss(beta - 0.05), miss(beta + 0.05))


@pytest.mark.parametrize("confinement", CONFINEMENTS)
def test_the_beta_of_the_whole_energy_leaves_an_area_of_that_energy_beyond_the_peak(confinement):
    one, s = Joint(beta=laws.whole_beta(confinement)), CONFINEMENTS[confinement]
    rise = 0.5 * float(one.peak(s) - one.residual(s)) ** 2 / one.ks
    assert shear_area("polynomial", one, s) - rise == pytest.approx(float(one.mode_2_energy(s)), rel=1e-9)


def test_capacity_holds_for_exact_curves_and_no_more_when_one_of_them_is_three_percent_lower(joints):
    assert laws.capacity(joints).holds
    joints.loaded["linear, 0.5 MPa"].summary["peak_stress_pa"] *= 0.97
    broken = laws.capacity(joints)
    assert broken.holds is False
    assert broken.why


def test_the_plateau_is_met_within_a_share_of_the_peak_and_the_polynomial_comes_down_to_it_where_the_claim_says(joints):
    assert laws.plateau(joints).holds
    joints.loaded["linear, 1.0 MPa"].summary["final_stress_pa"] += 0.06 * 1.88e6
    assert laws.plateau(joints).holds is False
    slip = laws.slip_of_plateau(joint("0.1 MPa"), 0.1e6)
    assert slip > 1e-3
    assert float(shear("polynomial", joint("0.1 MPa"), slip, 0.1e6)) == pytest.approx(1.05 * 0.073e6, rel=1e-3)


def test_laws_that_take_the_same_work_do_not_pass_for_different_ones(joints):
    assert laws.behaviours(joints).holds
    for c in CONFINEMENTS:
        joints.loaded[name("polynomial", c)] = joints.loaded[name("linear", c)] = joints[name("exponential", c)]
    assert laws.behaviours(joints).holds is False


def test_only_the_linear_law_takes_the_energy_that_it_is_given(joints):
    assert [claim.holds for claim in energies.energies(joints)] == [True, False, False]
    for c in CONFINEMENTS:
        joints.loaded[name("linear", c)].summary["energy_j"]["fracture_mode_2"] *= 1.1
    assert energies.energies(joints)[0].holds is False


def test_energies_that_would_snap_back_are_refused_with_the_least_that_works():
    assert energies.snap_back().holds


def test_a_bed_as_strong_as_the_tests_passes_and_a_weaker_one_does_not():
    for factor, holds in ((1.0, True), (0.85, False)):
        results = {
            mortar.name(size, c): result(factor * shear("exponential", Joint(), SLIP, s))
            for size in mortar.SIZES
            for c, s in CONFINEMENTS.items()
        }
        claims = mortar.capacity(done(results)), mortar.line(done(results)), mortar.residual(done(results))
        assert [claim.holds for claim in claims] == [holds] * 3


def test_cracks_are_told_apart_by_place_and_by_mode():
    """Four contacts: two interfaces, of which the lower is broken in shear, and two in the bed, one torn."""
    joints = SimpleNamespace(point=np.array([[0, 0, z] for z in (50.0, 65.0, 57.0, 58.0)]), area=np.full(4, 0.5 * AREA))
    tension, slip = np.array([0.0, 0.2, 1.0, 0.3]), np.array([1.0, 0.0, 0.0, 0.3])
    frame = SimpleNamespace(damage_tension=tension, damage_shear=slip, damage=1 - (1 - tension) * (1 - slip))
    one = SimpleNamespace(
        joints=joints,
        joint_group=np.array([0, 0, 1, 1]),
        joint_groups=("unit_mortar", "within_mortar"),
        history=SimpleNamespace(frames=[frame]),
        summary={"section_m2": AREA},
    )
    cracks = measures.cracks(one)
    assert (cracks.lower, cracks.upper, cracks.bed, cracks.bed_tension) == pytest.approx((0.5, 0.0, 0.5, 1.0))
    whole = measures.Cracks(0.5, 0.5, 0.0, 0.0)
    assert beds.places({"one": {1: cracks, 2: cracks, 3: cracks, 4: whole}}).holds
    assert beds.places({"one": {1: whole, 2: cracks, 3: cracks, 4: whole}}).holds is False
    assert beds.places({"one": {1: cracks, 2: cracks, 3: cracks, 4: cracks}}).holds is False
    assert beds.tensile({"one": {1: cracks, 4: whole}}).holds
    assert beds.tensile({"one": {1: whole, 4: whole}}).holds is False
    by_bed = dict.fromkeys((1, 2, 3), cracks) | {4: whole}
    for peaks, holds in (((0.84, 0.92, 0.92, 0.92), True), ((0.84, 0.89, 0.89, 0.92), False)):
        assert beds.at_once({"one": by_bed}, {"one": dict(zip(by_bed, peaks, strict=True))}).holds is holds


def test_the_stress_on_interfaces_is_weighed_by_area_in_the_frame_nearest_to_the_peak():
    far = SimpleNamespace(displacement=1.0, normal_stress=np.zeros(3), damage_shear=np.zeros(3))
    near = SimpleNamespace(
        displacement=0.2, normal_stress=np.array([1.0, -1.0, 9.0]), damage_shear=np.array([0.0, 0.1, 0.0])
    )
    one = SimpleNamespace(
        joints=SimpleNamespace(area=np.array([1.0, 3.0, 5.0])),
        joint_group=np.array([0, 0, 1]),
        joint_groups=("unit_mortar", "within_mortar"),
        history=SimpleNamespace(frames=[far, near]),
        summary={"displacement_at_peak_m": 0.3},
    )
    stress = measures.interfaces(one)
    assert (stress.scatter, stress.tension, stress.softened) == pytest.approx((np.sqrt(0.75), 0.25, 0.75))
    assert cells.uneven({"one": (stress, 1.0)}).holds
    assert cells.uneven({"one": (stress, 10.0)}).holds is False


@pytest.mark.parametrize("experiment", ["couplet", "meso-couplet"])
def test_a_quick_look_runs_a_part_of_the_whole(experiment):
    one = catalogue()[experiment]
    assert 0 < len(one.runs(True)) < len(one.runs(False))
    assert set(one.runs(True)) <= set(one.runs(False))


def test_every_claim_on_exact_curves_says_why_unless_it_holds(joints):
    for claim in [*laws.claims(joints), *energies.claims(joints)]:
        assert claim.holds or claim.why, claim.says
