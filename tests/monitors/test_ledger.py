"""The energy ledger closes in scenes of all kinds, from two independent sums, but not when a term is wrong."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from masonry.assembly.assemble import assemble
from masonry.configuration import energy
from masonry.errors import Stopped
from masonry.laboratory import laboratory
from masonry.model.layout import KINDS
from tests.scenes import MATERIAL, box, listed, load, specimen, tables

SOFT = """law = "{law}"
normal_stiffness = "{kn!r} GPa/m"
shear_stiffness = "{ks!r} GPa/m"
tensile_strength = "{ft!r} MPa"
cohesion = "{c!r} MPa"
tan_friction_angle = 0.9
residual_cohesion = "{c_res!r} MPa"
tan_residual_friction_angle = 0.6
fracture_energy_mode_1 = "{g1!r} N/m"
fracture_energy_mode_2 = "{g2!r} N/m"
exponent_tension = 3.0
exponent_shear = 2.5
"""
MIXED = '{default = "rigid", soft = "affine", fine = "tets"}'


def scene_text(kinematics: str, law: str, numbers: dict, damping: float, masses: str = "scaled", more: str = "") -> str:
    """Five blocks of three groups in running bond: held below, pushed sideways above, weighed down, pressed."""
    corners = [((0.0, 0.0, 0.0), "hard"), ((0.2, 0.0, 0.0), "fine"), ((0.1, 0.0, 0.08), "soft")]
    corners += [((0.3, 0.0, 0.08), "fine"), ((0.1, 0.0, 0.16), "soft")]
    boxes = [box(f"b{k}", low, (0.2, 0.1, 0.08), group, k) for k, (low, group) in enumerate(corners)]
    contact = SOFT.format(law=law, **numbers) + more
    pairs = ("fine_hard", "hard_soft", "fine_soft", "fine_fine", "soft_soft")
    return (
        f"kinematics = {kinematics}\n"
        + specimen(boxes, 0.02, "90 mm")
        + tables("material", dict.fromkeys(("hard", "soft", "fine"), MATERIAL))
        + tables("contact", dict.fromkeys(pairs, contact))
        + listed("support", ['on = "b0"\nfix = "all"', 'on = "b1"\nfix = ["x", "y", "z", "rotation"]'])
        + '[drive]\non = "b4"\ndirection = "x"\ndisplacement = "0.06 mm"\nsteps = 3000\n'
        + listed("traction", ['on = "b3.z+"\nstress = {x = "2 kPa", z = "-0.1 MPa"}'])
        + '[gravity]\nz = "-9.81 m/s^2"\ny = "1 m/s^2"\n[settle]\nsteps = 800\n'
        + f'[solver]\nmasses = "{masses}"\ndamping = {damping!r}\nrows = 100\nrotation_limit = 1.0\n'
    )


numbers = st.fixed_dictionaries(
    {
        "kn": st.floats(50, 400),
        "ks": st.floats(20, 200),
        "ft": st.floats(0.05, 0.6),
        "c": st.floats(0.1, 0.9),
        "c_res": st.floats(0.0, 0.05),
        "g1": st.floats(5.0, 30.0),
        "g2": st.floats(30.0, 200.0),
    }
)
USUAL = {"kn": 150.0, "ks": 70.0, "ft": 0.2, "c": 0.3, "c_res": 0.01, "g1": 5.0, "g2": 40.0}


def rows_of(text: str) -> tuple[dict, dict]:
    """Rows and summary, also of a run that was stopped."""
    try:
        result = laboratory.run(load(text))
    except Stopped as stop:
        result = stop.result
    return result.history.rows, result.summary


def assert_closes(rows: dict) -> None:
    work = np.abs(rows["external_work"]).max()
    assert work > 0
    assert np.abs(rows["imbalance"]).max() < 1e-12 * work
    for key in ("fracture_mode_1", "fracture_mode_2", "friction", "damping"):
        assert np.diff(rows[key]).min() >= -1e-9 * work, f"{key} never falls"


@settings(max_examples=8, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(numbers=numbers, masses=st.sampled_from(["scaled", "real"]))
@pytest.mark.parametrize("damping", [0.0, 0.8])
def test_the_ledger_closes_to_round_off_in_scenes_of_all_kinds_at_once(damping, numbers, masses):
    rows, summary = rows_of(scene_text(MIXED, "exponential", numbers, damping, masses))
    assert_closes(rows)
    assert summary["energy_imbalance"] < 1e-12


def each_law_and_each_kinematics():
    """By default two laws with rigid blocks, and every kinematics with one law; the rest is slow to compile."""
    usual_laws = {"rigid": ("brittle", "exponential"), "affine": ("exponential",), "tets": ("linear",)}
    for kinematics, usual in usual_laws.items():
        for law in ("brittle", "linear", "polynomial", "exponential"):
            marks = () if law in usual else (pytest.mark.slow,)
            yield pytest.param(f'"{kinematics}"', law, id=f"{kinematics}-{law}", marks=marks)


@pytest.mark.parametrize(("kinematics", "law"), list(each_law_and_each_kinematics()))
def test_the_ledger_closes_for_every_law_and_kinematics(kinematics, law):
    rows, _ = rows_of(scene_text(kinematics, law, USUAL, 0.8))
    assert_closes(rows)
    assert rows["friction"][-1] + rows["fracture_mode_2"][-1] > 0, "something did slip"


@pytest.mark.parametrize("law", ["linear", "polynomial", "exponential"])
@pytest.mark.parametrize("kinematics", [MIXED, '"rigid"'], ids=["mostly mode II and friction", "mostly mode I"])
def test_what_the_laws_book_is_what_the_contacts_take_less_what_they_store(kinematics, law):
    rows, summary = rows_of(scene_text(kinematics, law, USUAL, 0.8))
    booked = sum(rows[key] for key in ("fracture_mode_1", "fracture_mode_2", "friction"))
    lost = rows["contact_work"] - rows["elastic_contacts"]
    assert booked[-1] > 0.2 * np.abs(rows["external_work"]).max(), "it is not a matter of small change"
    assert lost[-1] == pytest.approx(booked[-1], rel=2e-4)
    assert summary["dissipation_mismatch"] < 2e-4


def test_undamped_the_two_sums_meet_as_the_step_shrinks():
    """Vibrations of a few steps a period make the trapezoid coarse where a contact softens: first order in the step."""
    gap = []
    for finer in (1, 4):
        text = scene_text(MIXED, "exponential", USUAL, 0.0, "real")
        text = text.replace("steps = 3000", f"steps = {3000 * finer}").replace("steps = 800", f"steps = {800 * finer}")
        gap.append(rows_of(text + f"step_fraction = {0.9 / finer}\n")[1]["dissipation_mismatch"])
    assert gap[1] < 5e-4
    assert gap[1] < 0.4 * gap[0]


OPTIONS = [
    'unloading = "elastic"',
    'softening_variable = "plastic"',
    'coupling = "independent"',
    'dilation_angle = "5 deg"',
]


@pytest.mark.parametrize("option", OPTIONS)
def test_both_sums_agree_with_every_option_of_the_laws(option):
    rows, summary = rows_of(scene_text('"rigid"', "exponential", USUAL, 0.8, more=option + "\n"))
    assert_closes(rows)
    assert summary["dissipation_mismatch"] < 1e-3


def imbalance_of(text: str) -> float:
    rows, _ = rows_of(text)
    return float(np.abs(rows["imbalance"]).max() / np.abs(rows["external_work"]).max())


def plain_kinetic(model, before):
    """The wrong one: m v v / 2 with the velocity after the step."""
    present = [(k, b) for k, b in zip(KINDS, model.bodies, strict=True) if b is not None]
    return 0.5 * sum(float(np.sum(model.masses[k] * b.v**2)) for k, b in present)


def test_a_kinetic_energy_taken_at_the_wrong_time_is_detected(monkeypatch):
    text = scene_text(MIXED, "exponential", USUAL, 0.0, "real")
    assert imbalance_of(text) < 1e-12
    monkeypatch.setattr(energy, "kinetic", plain_kinetic)
    assert imbalance_of(text) > 1e-6


@pytest.mark.parametrize("term", ["elastic_blocks", "elastic_contacts"])
def test_a_stored_energy_that_is_wrong_by_a_hundredth_is_detected(monkeypatch, term):
    text = scene_text(MIXED, "exponential", USUAL, 0.8)
    right = energy.observe

    def wrong(model):
        view = right(model)
        return replace(view, **{term: 1.01 * getattr(view, term)})

    monkeypatch.setattr(energy, "observe", wrong)
    rows, summary = rows_of(text)
    imbalance = np.abs(rows["imbalance"]).max() / np.abs(rows["external_work"]).max()
    if term == "elastic_blocks":
        assert imbalance > 1e-6
    else:
        assert summary["dissipation_mismatch"] > 1e-6
        assert imbalance < 1e-12, "the balance itself rests on the contacts' work, not on their state"


def test_a_mass_that_moves_but_is_not_counted_is_detected():
    from masonry.timeloop import timeloop

    assembly = assemble(load(scene_text(MIXED, "exponential", USUAL, 0.0, "real")))
    assembly.model.masses["affine"][:, 3:] *= 1.1
    rows = timeloop.run(assembly.model, assembly.plan, assembly.recording).history.rows
    assert np.abs(rows["imbalance"]).max() > 1e-8 * np.abs(rows["external_work"]).max()
