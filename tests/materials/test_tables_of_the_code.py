"""Tables of Eurocode 6 and published rules, whole, and at both ends of every range."""

import itertools

import pytest

import masonry
from masonry.errors import SceneError
from masonry.materials import published_rules as rules
from masonry.materials.contact_data import ContactData
from masonry.materials.eurocode_6 import UNITS, bending_strength, compressive_strength, shear_strength
from masonry.materials.joint_strengths import joint_strengths

MPA = 1e6
ABOVE, BELOW = 1.0 + 1e-6, 1.0 - 1e-6
K = {
    ("clay", "general purpose"): (0.55, 0.45, 0.35, 0.35),
    ("clay", "thin layer"): (0.75, 0.70, 0.50, 0.35),
    ("calcium-silicate", "general purpose"): (0.55, 0.45, None, None),
    ("calcium-silicate", "thin layer"): (0.80, 0.65, None, None),
    ("concrete", "general purpose"): (0.55, 0.45, 0.40, 0.35),
    ("concrete", "thin layer"): (0.80, 0.65, 0.50, None),
    ("aac", "general purpose"): (0.55, None, None, None),
    ("aac", "thin layer"): (0.80, None, None, None),
    ("manufactured-stone", "general purpose"): (0.45, None, None, None),
    ("manufactured-stone", "thin layer"): (None, None, None, None),
    ("natural-stone", "general purpose"): (0.45, None, None, None),
    ("natural-stone", "thin layer"): (None, None, None, None),
}
"""Table 3.3, groups 1 to 4."""
POWER = {("clay", 2): 0.7, ("clay", 3): 0.7}
"""Of f_b with thin layer mortar, eq. (3.3) and (3.4); 0.85 for all others."""
F_VK0 = {
    "clay": (0.30, 0.20, 0.10, 0.30),
    "calcium-silicate": (0.20, 0.15, 0.10, 0.40),
    "concrete": (0.20, 0.15, 0.10, 0.30),
    "aac": (0.20, 0.15, 0.10, 0.30),
    "manufactured-stone": (0.20, 0.15, 0.10, 0.30),
    "natural-stone": (0.20, 0.15, 0.10, 0.30),
}
"""Table 3.4 in MPa: M10 to M20, M2.5 to M9, M1 to M2, thin layer mortar."""
F_XK1 = {
    "clay": (0.10, 0.10, 0.15),
    "calcium-silicate": (0.05, 0.10, 0.20),
    "concrete": (0.05, 0.10, 0.20),
    "aac": (0.05, 0.10, 0.15),
    "manufactured-stone": (0.05, 0.10, None),
    "natural-stone": (0.05, 0.10, 0.15),
}
"""3.6.3 in MPa: f_m below 5 MPa, of 5 MPa and more, thin layer mortar."""


def value(strength):
    return None if strength is None else pytest.approx(strength.value / MPA, rel=1e-9)


@pytest.mark.parametrize(("unit", "group"), list(itertools.product(UNITS, (1, 2, 3, 4))))
def test_compressive_strength_has_the_factors_and_powers_of_table_3_3(unit, group):
    factor, thin = (K[unit, mortar][group - 1] for mortar in ("general purpose", "thin layer"))
    wanted = None if factor is None else factor * 17.0**0.7 * 6.0**0.3
    assert wanted == value(compressive_strength(unit, group, 17.0 * MPA, 6.0 * MPA))
    wanted = None if thin is None else thin * 17.0 ** POWER.get((unit, group), 0.85)
    assert wanted == value(compressive_strength(unit, group, 17.0 * MPA, None))


@pytest.mark.parametrize(
    ("f_b", "f_m", "counted"),
    [
        (74.0, 19.0, (74.0, 19.0)),
        (75.0, 20.0, (75.0, 20.0)),
        (76.0, 21.0, (75.0, 20.0)),
        (300.0, 19.0, (75.0, 19.0)),
        (4.0, 7.9, (4.0, 7.9)),
        (4.0, 8.1, (4.0, 8.0)),
        (9.0, 19.0, (9.0, 18.0)),
        (11.0, 30.0, (11.0, 20.0)),
    ],
)
def test_units_count_to_75_mpa_and_mortar_to_20_mpa_and_twice_the_units(f_b, f_m, counted):
    wanted = 0.45 * counted[0] ** 0.7 * counted[1] ** 0.3
    assert wanted == value(compressive_strength("concrete", 2, f_b * MPA, f_m * MPA))


@pytest.mark.parametrize(("f_b", "counted"), [(49.0, 49.0), (50.0, 50.0), (51.0, 50.0), (76.0, 50.0)])
@pytest.mark.parametrize(("unit", "group"), [("clay", 1), ("clay", 2), ("calcium-silicate", 1)])
def test_units_in_thin_layers_count_to_50_mpa(f_b, counted, unit, group):
    wanted = K[unit, "thin layer"][group - 1] * counted ** POWER.get((unit, group), 0.85)
    assert wanted == value(compressive_strength(unit, group, f_b * MPA, None))


@pytest.mark.parametrize("unit", UNITS)
def test_shear_and_bending_strength_of_each_class_of_mortar(unit):
    strong, medium, weak, thin = F_VK0[unit]
    ends = [(0.99, None), (1.0, weak), (2.0, weak), (2.49, weak), (2.5, medium), (9.0, medium), (9.99, medium)]
    for f_m, wanted in [*ends, (10.0, strong), (20.0, strong), (35.0, strong)]:
        assert wanted == value(shear_strength(unit, f_m * MPA)), f"f_m = {f_m} MPa"
    assert thin == value(shear_strength(unit, None))
    low, high, thin = F_XK1[unit]
    for f_m, wanted in [(1.0, low), (4.99, low), (5.0, high), (20.0, high)]:
        assert wanted == value(bending_strength(unit, f_m * MPA)), f"f_m = {f_m} MPa"
    assert thin == value(bending_strength(unit, None))


def strengths(**known):
    return joint_strengths(ContactData({"unit": "clay", "unit_strength": "20 MPa", "mortar": "M5", **known}))


def test_characteristic_values_become_means_by_the_share_of_each_test():
    """0.8 in shear, 1/1.5 in bending and in tension, 1/1.2 in compression; the code's tables and the user's alike."""
    code = strengths()
    assert (code.cohesion.mean, code.flexural.mean) == pytest.approx((0.20e6 / 0.8, 0.10e6 * 1.5))
    assert code.compression.mean == pytest.approx(1.2 * 0.55 * 20**0.7 * 5**0.3 * 1e6)
    assert code.friction.mean == pytest.approx(0.4 / 0.8) and code.tension is None
    assert (code.cohesion.low, code.cohesion.high) == pytest.approx((0.20e6, 2.0 * 0.25e6))
    assert (code.friction.high, code.compression.high) == pytest.approx((0.8, 1.5 * code.compression.mean))
    tests = {"cohesion": "0.3 MPa", "friction": 0.72, "bond_strength": "0.33 MPa", "masonry_strength": "7 MPa"}
    for basis, (shear, bending, pressed) in (("mean", (1.0, 1.0, 1.0)), ("characteristic", (1.25, 1.5, 1.2))):
        own = strengths(**tests, basis=basis)
        assert (own.cohesion.mean, own.friction.mean) == pytest.approx((0.3e6 * shear, 0.72 * shear))
        assert own.flexural.mean == pytest.approx(0.33e6 * bending)
        assert own.compression.mean == pytest.approx(7e6 * pressed)
        assert own.cohesion.characteristic == pytest.approx(0.8 * own.cohesion.mean)
        assert own.cohesion.high - own.cohesion.mean == pytest.approx(own.cohesion.mean - own.cohesion.low)
    direct = strengths(tensile_strength="0.2 MPa", basis="characteristic").tension
    assert (direct.mean, direct.low, direct.high) == pytest.approx((0.3e6, 0.2e6, 0.4e6))


def test_a_cohesion_is_noted_as_high_from_2_mpa_on():
    for cohesion, noted in (("1.99 MPa", False), ("2.01 MPa", True)):
        assert any("is high" in note for note in strengths(cohesion=cohesion).notes) is noted


@pytest.mark.parametrize(
    ("rule", "known", "wanted"),
    [
        (rules.direct_tension, 0.45e6, (0.3e6, 0.18e6, 0.45e6)),
        (rules.mode_1_energy, 0.3e6, (12.0, 5.0, 20.0)),
        (rules.mode_1_energy, 0.15e6, (12.0, 2.5, 20.0)),
        (rules.mode_1_energy, 0.6e6, (12.0, 5.0, 20.0)),
        (rules.mode_1_energy, 0.01e6, (12.0, 0.5, 20.0)),
        (rules.mode_2_energy, 0.1e6 * BELOW, (10.0, 5.0, 40.0)),
        (rules.mode_2_energy, 0.15e6, (15.0, 7.5, 60.0)),
        (rules.mode_2_energy, 0.3e6, (30.0, 10.0, 120.0)),
        (rules.mode_2_energy, 1.8e6, (180.0, 10.0, 720.0)),
        (rules.tension_from_cohesion, 0.3e6, (0.2e6, 0.09e6, 0.3e6)),
        (rules.residual_friction, 0.6, (0.6, 0.48, 0.6)),
        (rules.residual_friction, 0.8, (0.75, 0.6, 0.8)),
        (rules.residual_friction, 1.2, (0.75, 0.6, 0.9)),
    ],
)
def test_published_rules_have_their_value_and_their_range(rule, known, wanted):
    assert rule(known)[:3] == pytest.approx(wanted, rel=1e-5)
    assert rules.mode_2_slope()[:3] == (0.0, 0.0, 130e-6)


@pytest.mark.parametrize(
    ("strength", "per_mm"),
    [
        (11.99, 1.6 * 11.99),
        (12.0, 15.0 + 0.43 * 12.0 - 0.0036 * 12.0**2),
        (40.0, 15.0 + 0.43 * 40.0 - 0.0036 * 40.0**2),
        (80.0, 15.0 + 0.43 * 80.0 - 0.0036 * 80.0**2),
        (80.01, 0.33 * 80.01),
    ],
)
def test_the_energy_of_crushing_is_that_of_model_code_90_in_each_of_its_ranges(strength, per_mm):
    rule = rules.crushing_energy(strength * MPA)
    assert rule[:3] == pytest.approx((1e3 * per_mm, 300.0 * per_mm, 1e3 * per_mm))
    shown = "1.6 mm x f" if strength < 12.0 else "0.33 mm x f" if strength > 80.0 else "15 + 0.43 f"
    assert rule.source.startswith(shown)


def test_the_closing_at_the_peak_is_what_two_per_mille_leave_beside_the_elastic_share():
    """0.1 m of 8 MPa and 8 GPa: 2, 1.5 and 4 per mille, less 1."""
    assert rules.closing_at_peak(0.1, 8e6, 8e9)[:3] == pytest.approx((0.1e-3, 0.05e-3, 0.3e-3))
    assert rules.closing_at_peak(0.1, 8e6, 5e9)[:3] == pytest.approx((0.04e-3, 0.01e-3, 0.24e-3))
    assert rules.closing_at_peak(0.1, 8e6, 4e9 * ABOVE) is not None and rules.closing_at_peak(0.1, 8e6, 4e9) is None


MODULI = {"unit_height": "65 mm", "joint": "10 mm", "law": "elastic"}


@pytest.mark.parametrize(
    ("known", "value", "low", "high", "share"),
    [
        ({"masonry_modulus": "6 GPa"}, 6e9, 4.5e9, 7.5e9, 0.4),
        ({"masonry_strength": "7.2 MPa", "poisson": 0.25}, 6e9, 3e9, 12e9, 0.4),
        (
            {"unit_modulus": "13 GPa", "mortar_modulus": "2 GPa", "poisson": 0.1},
            0.075 / (0.005e-9 + 0.005e-9),
            0.075 / (0.005e-9 + 0.010e-9),
            0.075 / (0.005e-9 + 0.0025e-9),
            0.5 / 1.1,
        ),
    ],
)
def test_the_stiffness_of_a_joint_and_its_range_follow_from_what_is_known(known, value, low, high, share):
    """Rigid units: E over the height of a course; of masonry give or take a quarter, of mortar half to twice."""
    table = masonry.contact(**MODULI, **known)
    key = "contact.unit_unit.normal_stiffness"
    amount = float(table["contact.unit_unit"]["normal_stiffness"].split()[0]) * 1e9
    assert amount == pytest.approx(value / 0.075, rel=1e-4)
    assert table.ranges[key] == pytest.approx((low / 0.075, high / 0.075), rel=1e-4)
    shear = float(table["contact.unit_unit"]["shear_stiffness"].split()[0]) * 1e9
    assert shear / amount == pytest.approx(0.5 / 1.25 if known.get("poisson") == 0.25 else share, rel=1e-4)


def test_the_pressure_from_which_the_code_limits_shear_is_that_at_which_its_line_gets_there():
    """0.065 f_b = 1.3 MPa less 0.2 MPa, over 0.4."""
    table = masonry.contact(unit="clay", unit_strength="20 MPa", mortar="M5", unit_height="65 mm", joint="10 mm")
    (note,) = (note for note in table.notes if "0.065 f_b" in note)
    assert "above a compression of 2.75 MPa" in note
    weak = masonry.contact(unit="clay", unit_strength="3 MPa", mortar="M5", unit_height="65 mm", joint="10 mm")
    assert not any("0.065 f_b" in note for note in weak.notes), "0.195 MPa is below the cohesion of 0.2 MPa"


def test_a_joint_is_no_thicker_than_its_unit_and_a_thin_one_is_noted_from_3_mm_on():
    with pytest.raises(SceneError, match="exchanged"):
        masonry.contact(unit_height="10 mm", joint="10.1 mm", masonry_modulus="6 GPa", law="elastic")
    even = masonry.contact(unit_height="10 mm", joint="10 mm", masonry_modulus="6 GPa", law="elastic")
    assert even.modulus == pytest.approx(6e9)
    thin = {"unit": "clay", "unit_strength": "20 MPa", "unit_height": "65 mm", "mortar": "thin-layer"}
    for joint, noted in (("2.99 mm", False), ("3.01 mm", True)):
        notes = masonry.contact(joint=joint, **thin).notes
        assert any("thin layer mortar has joints" in note for note in notes) is noted
