"""Random cyclic paths in three dimensions: what must hold for every law with every option."""

from itertools import product

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from masonry.laws.state import TOUCHING
from verification.fixtures.one_contact import Walk, contact, law, walk
from verification.references.closed_forms import LAWS, Joint, shear_area

KN, KS = 150e9, 70e9
NAMES = ("unloading", "softening_variable", "coupling", "dilation_angle")
CHOICES = (("secant", "elastic"), ("displacement", "plastic"), ("combined", "independent"), (0.0, 0.15))


def combinations():
    """Every law with every option. By default eight of the 16 sets of options meet one law each, in which any three
    options meet each other in all ways; the mechanism is the same for all laws. The rest is slow to compile."""
    for number, name in enumerate(LAWS):
        for p in product((0, 1), repeat=4):
            partner = (p[0] ^ p[1] ^ p[2]) + 2 * (p[1] ^ p[2] ^ p[3])
            marks = () if partner == number and sum(p) % 2 == 0 else (pytest.mark.slow,)
            options = {key: choice[k] for key, choice, k in zip(NAMES, CHOICES, p, strict=True)}
            words = [str(v) for v in options.values() if v != 0.0]
            yield pytest.param(name, options, id="-".join([name, *words]), marks=marks)


every_law_and_option = pytest.mark.parametrize(("name", "options"), list(combinations()))
unhurried = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=True)

share = st.floats(-1.0, 1.0, allow_nan=False).map(lambda x: round(x, 3))
corner = st.tuples(share, share, share)
numbers = st.fixed_dictionaries(
    {
        "tensile_strength": st.sampled_from([0.0, 0.2e6, 0.58e6]),
        "cohesion": st.sampled_from([0.0, 0.3e6, 0.87e6]),
        "residual_cohesion": st.sampled_from([0.0, 0.5, 1.0]),
        "tan_residual_friction": st.sampled_from([0.2, 0.73, 1.01]),
        "fracture_energy_mode_2_slope": st.sampled_from([0.0, 130e-6]),
    }
)


@st.composite
def corners(draw, least: int = 2, most: int = 7) -> np.ndarray:
    """(n, 3) m: slips up to 3, 30 or 300 um, openings up to 40 um and down to -12 um, some exactly at zero."""
    scale = draw(st.sampled_from([3e-6, 30e-6, 300e-6]))
    points = np.array(draw(st.lists(corner, min_size=least, max_size=most)))
    height = draw(st.sampled_from([1e-6, 5e-6, 40e-6]))
    points[:, :2] *= scale
    points[:, 2] *= np.where(points[:, 2] > 0, height, min(height, 12e-6))
    return points


def legs(points: np.ndarray, steps: int) -> np.ndarray:
    """(N, 3): from the origin through the points, `steps` a leg."""
    begin = np.vstack([np.zeros(3), points[:-1]])
    part = np.arange(1, steps + 1)[:, None] / steps
    return np.concatenate([a + part * (b - a) for a, b in zip(begin, points, strict=True)])


def chosen(name: str, options: dict, values: dict) -> tuple:
    """The law with these numbers; the residual cohesion is given as a share of the cohesion."""
    values = {**values, "residual_cohesion": values["residual_cohesion"] * values["cohesion"]}
    return law(name, **{**options, **values})


def strengths(joint, trace: Walk) -> tuple[np.ndarray, np.ndarray]:
    """The most that tension and shear may be, from the history and the normal stress that acts: eqs (7), (8)."""
    together = joint.combined is not None
    left_n = trace.intact_n * (trace.intact_s if together else 1.0)
    left_s = trace.intact_s * (trace.intact_n if together else 1.0)
    peak = np.maximum(joint.cohesion - trace.sigma * joint.tan_friction, 0.0)
    residual = np.maximum(joint.residual_cohesion - trace.sigma * joint.tan_residual_friction, 0.0)
    return left_n * joint.tensile_strength, residual + left_s * np.maximum(peak - residual, 0.0)


@every_law_and_option
@settings(unhurried, max_examples=40)
@given(points=corners(), values=numbers, steps=st.sampled_from([1, 7, 60]))
def test_dissipation_never_decreases_and_strength_never_grows(name, options, points, values, steps):
    require_dissipation(chosen(name, options, values), legs(points, steps))


def require_dissipation(law: tuple, path: np.ndarray) -> None:
    """Whatever the path: nothing is given back that was spent, and nothing heals."""
    joint, trace = law[1], walk(law, path)
    assert np.isfinite(trace.stress).all() and np.isfinite(trace.stored).all()
    total = np.concatenate([[0.0], trace.dissipated])
    rounding = 1e-12 * (np.max(total) + 1e-6)
    assert np.min(np.diff(total)) >= -rounding
    assert np.min(np.diff(trace.dissipated_by_mode, axis=0, prepend=0.0)[:, :2]) >= -rounding
    if joint.tan_dilation is None:
        assert np.min(np.diff(trace.dissipated_by_mode[:, 2], prepend=0.0)) >= -rounding
    for falling in (trace.intact_n, trace.intact_s, -trace.opening_max):
        assert np.max(np.diff(falling)) <= 0.0 if len(falling) > 1 else True
    assert np.all((trace.intact_n >= 0.0) & (trace.intact_n <= 1.0))
    assert np.all((trace.intact_s >= 0.0) & (trace.intact_s <= 1.0))
    assert np.all(trace.stored >= -rounding)
    tensile, shear = strengths(joint, trace)
    assert np.all(trace.tau <= shear * (1 + 1e-9) + 1e-3)
    assert np.all(trace.sigma <= tensile * (1 + 1e-9) + 1e-3)


@every_law_and_option
@settings(unhurried, max_examples=15)
@given(points=corners(), values=numbers)
def test_work_less_stored_less_spent_vanishes_with_the_step(name, options, points, values):
    chosen_law = chosen(name, options, values)
    walks = [walk(chosen_law, legs(points, steps)) for steps in (100, 200, 400, 3200)]
    errors = [np.max(np.abs(w.gap)) for w in walks]
    scale = walks[-1].dissipated[-1] + np.max(walks[-1].stored) + 1e-9
    allowed = 0.3 * max(errors[:3]) + 1e-9 * scale
    if chosen_law[1].tensile_strength == 0.0:  # faces part within a nanometre, which long steps skip
        allowed += 0.5 * KN * TOUCHING**2
    if name == "brittle":  # a drop falls anywhere in its step, whose work is known to drop x step and no better
        step = np.max(np.linalg.norm(np.diff(walks[-1].path, axis=0), axis=1))
        allowed += 2.0 * np.max(np.linalg.norm(walks[-1].stress, axis=1)) * step
        if options["dilation_angle"]:  # from tension into compression within that step: the kink is booked by its chord
            allowed += 2e-3 * scale
    if errors[3] > allowed:  # the long steps were lucky, or leapt over the nanometre in which faces part
        errors.append(np.max(np.abs(walk(chosen_law, legs(points, 12_800)).gap)))
        allowed = max(allowed, 0.3 * errors[3])
    assert errors[-1] <= allowed


@every_law_and_option
@settings(unhurried, max_examples=15)
@given(points=corners(least=1, most=3), values=numbers, low=st.floats(-8e-6, -1e-7), slip=share)
def test_force_is_continuous_where_the_faces_meet_again(name, options, points, values, low, slip):
    """The jump across closing is no more than stiffness times the step, so it halves with the step."""
    parameters, joint = chosen(name, options, values)
    before = legs(np.vstack([points, [0.0, 0.0, 30e-6]]), 50)
    end = before[-1] + np.array([slip * 40e-6, 0.0, low - before[-1, 2]])
    for steps in (400, 800, 1600):
        state = contact(joint)
        walk((parameters, joint), before, state)
        trace = walk(
            (parameters, joint), before[-1] + np.arange(steps + 1)[:, None] / steps * (end - before[-1]), state
        )
        jump = np.linalg.norm(np.diff(trace.stress, axis=0), axis=1)
        step = np.linalg.norm(end - before[-1]) / steps
        rest = 0.0 if state.permanent_opening is None else float(state.permanent_opening[0])
        lift = 0.0 if state.dilation is None else float(state.dilation[0])
        touching = np.abs(trace.path[1:, 2] - rest - lift) <= 2 * step
        closing = touching | (np.abs(trace.path[1:, 2]) <= 2 * step) | (np.abs(trace.path[1:, 2] - lift) <= 2 * step)
        stiffest = (KN + KS) * (2.0 + joint.tan_friction)
        assert np.all(jump[closing] <= stiffest * step)


def closed(points: np.ndarray, steps: int) -> np.ndarray:
    """(N, 3): through the points and back to the origin."""
    return legs(np.vstack([points, np.zeros(3)]), steps)


ENOUGH = {"fracture_energy_mode_2": 2000.0, "fracture_energy_mode_1": 20.0}
"""N/m with which no law snaps back under the compression that these paths, and dilation, bring."""


@every_law_and_option
@settings(unhurried, max_examples=11)
@given(points=corners(), values=numbers)
def test_on_a_closed_path_no_jump_is_left_as_the_steps_get_shorter(name, options, points, values):
    """A quarter of the step, a quarter of the largest jump, unless this is no more than elastic: opening, slip both
    ways, changing compression.

    Strength without fracture energy is lost at once: brittle contacts, and faces without tensile strength that part.
    """
    values = {**values, "tensile_strength": values["tensile_strength"] or 0.58e6}
    if name == "brittle":
        return
    chosen_law = chosen(name, options, {**values, **ENOUGH})
    walks = [walk(chosen_law, closed(points, steps)) for steps in (400, 1600)]
    coarse, fine = (np.linalg.norm(np.diff(w.stress, axis=0, prepend=0.0), axis=1).max() for w in walks)
    step = np.linalg.norm(np.diff(walks[1].path, axis=0), axis=1).max()
    assert fine <= max(0.3 * coarse, (KN + KS) * step), "or it is what springs make of the step"


@every_law_and_option
@settings(unhurried, max_examples=11)
@given(points=corners(), values=numbers)
def test_a_closed_path_takes_no_more_of_mode_2_than_the_law_has_at_the_largest_compression(
    name, options, points, values
):
    """However often it turns back; the area of the whole curve above the residual, its elastic part included.

    A residual cohesion that torn faces lose as they open, and find again on closing, is booked with mode II as well.
    """
    given = chosen(name, options, values)
    trace = walk(given, closed(points, 1600))
    joint, most = given[1], max(float(-trace.sigma.min()), 0.0)
    closed_form = Joint(c0=joint.cohesion, c_res=joint.residual_cohesion, tan_res=joint.tan_residual_friction,
                  G_II_slope=values["fracture_energy_mode_2_slope"])  # fmt: skip
    fades = joint.residual_cohesion > 0.0 and trace.intact_n[-1] < 1.0
    if closed_form.peak(most) > closed_form.residual(most) and not fades:
        between = (0.0, most) if joint.cohesion else (most,)
        step = np.linalg.norm(np.diff(trace.path, axis=0), axis=1).max()
        one_step = step * float(closed_form.peak(most) - closed_form.residual(most)) if name == "brittle" else 0.0
        assert (
            trace.dissipated_by_mode[-1, 1] <= 1.005 * max(shear_area(name, closed_form, p) for p in between) + one_step
        )


@every_law_and_option
@settings(unhurried, max_examples=11)
@given(points=corners(), values=numbers)
def test_a_closed_path_without_damage_gives_all_its_work_back(name, options, points, values):
    strong = {"tensile_strength": values["tensile_strength"] or 0.2e6, "cohesion": values["cohesion"] or 0.3e6}
    chosen_law, path = chosen(name, options, {**values, **strong}), closed(points, 20)
    for _ in range(12):
        trace = walk(chosen_law, path)
        if not trace.dissipated.any() and not trace.slip.any() and trace.intact_n[-1] == 1.0:
            break
        path = 0.5 * path
    most = np.abs(trace.work).max()
    assert not trace.dissipated.any() and np.abs(trace.gap[-1]) <= 1e-12 * most
    assert trace.stored[-1] <= 1e-12 * trace.stored.max()


@every_law_and_option
@settings(unhurried, max_examples=15)
@given(points=corners(), turn=st.floats(0.0, 6.3))
def test_the_frame_of_the_slip_does_not_matter(name, options, points, turn):
    steps, tolerance = 30, 1e-7
    chosen_law = law(name, **options)
    path = legs(points, steps)
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    one, other = walk(chosen_law, path), walk(chosen_law, path @ rotation.T)
    size = np.max(np.abs(one.stress)) + 1.0
    np.testing.assert_allclose(other.stress, one.stress @ rotation.T, rtol=0, atol=tolerance * size)
    np.testing.assert_allclose(
        other.dissipated_by_mode, one.dissipated_by_mode, rtol=0, atol=tolerance * (one.dissipated[-1] + 1e-6)
    )
