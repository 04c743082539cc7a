"""Every limit of the sentence of trust, asked a hundredth below and a hundredth above: nothing, and exactly its doubt.

The limits stand here as numbers of their own, so that one that is widened, narrowed or asked of another number fails.
"""

import json
from typing import Any

import pytest

from masonry.judgement.catalogue import criteria
from masonry.judgement.doubt import Doubt
from masonry.judgement.judgement import judge, judgement_of
from masonry.judgement.sentence import CONVERGE, advice, trust
from tests.judgement.summaries import AT_REST, DRIVEN, GROWN, LED, LOOPS, REAL_TIME, SHAKEN, with_numbers

LIMITS = [
    (DRIVEN, "energy_imbalance", 1e-9, "the energy balance is open by 1"),
    (DRIVEN, "energy_imbalance", -1e-9, "the energy balance is open by 1"),
    (DRIVEN, "dissipation_mismatch", 0.01, "laws and contacts disagree on the dissipated energy by 1.01 %"),
    (DRIVEN, "force_balance", 1e-9, "forces and moments add up to 1e-09 of the largest"),
    (DRIVEN, "overlap_max", 0.01, "contacts close by up to 0.01 of a block's size"),
    (DRIVEN, "slip_max", 0.05, "contacts slid by up to 0.05"),
    (DRIVEN, "compression_over_strength", 1.0, "contacts bear up to 1.01 times their compressive strength"),
    (with_numbers(DRIVEN, slip_limit=0.5), "slip_max", 0.1, "contacts slid by up to 0.1"),
    (DRIVEN, "released_over_dissipated", 0.01, "sudden cracks released 1 %"),
    (with_numbers(DRIVEN, released_over_dissipated=0.5), "released_over_work", 1e-3, "sudden cracks released 50 %"),
    (DRIVEN, "damping_over_external", -0.01, "not quasi-static: damping added 1 % of the work and removed none"),
    (DRIVEN, "damping_over_external", 0.02, "not quasi-static: damping takes 0.02 of the work (should be under 0.02)"),
    (DRIVEN, "reaction_mismatch_max", 0.02, "not quasi-static: the forces at drive and support differ by 0.02"),
    (DRIVEN, "kinetic_over_internal_max", 0.05, "not quasi-static: the kinetic energy reaches 0.051 of the int"),
    (DRIVEN, "unbalanced_after_settling", 1e-3, "the dead loads had not come to rest: 0.001 of them is unbal"),
    (DRIVEN, "kinetic_after_settling", 1e-6, "the dead loads had not come to rest: the kinetic energy is"),
    (SHAKEN, "unbalanced_after_settling", 1e-3, "the dead loads had not come to rest: 0.001 of them is unbal"),
    (SHAKEN, "kinetic_after_settling", 1e-6, "the dead loads had not come to rest: the kinetic energy is"),
    (
        DRIVEN,
        "unrest_after_settling__unbalanced",
        1e-2,
        "block 3 at (0.1, 0.2, 0.3) m had not come to rest under the",
    ),
    (DRIVEN, "unrest_after_settling__kinetic", 1e-4, "block 3 at (0.1, 0.2, 0.3) m had not come to rest under the"),
    (AT_REST, "moving_at_end__kinetic", 1e-4, "block 3 at (0.1, 0.2, 0.3) m still moves at the end: its kinetic"),
    (DRIVEN, "control__drag_at_peak", 0.01, "not quasi-static: damping took 1 % of the force at the peak"),
    (
        with_numbers(DRIVEN, control__accuracy=0.03),
        "control__drag_at_peak",
        0.03,
        "not quasi-static: damping took 3 % of the force at",
    ),
    (with_numbers(DRIVEN, law_by_group={"beds": "elastic", "heads": "friction"}), "rise_at_end", 0.01, "the force st"),
    (DRIVEN, "rise_at_end", 0.01, "the force still rose at the end, by 1 % over the last tenth of the drive: the h"),
    (
        REAL_TIME,
        "swing_too_wide",
        0.01,
        "steps are long beside the swings, which are too wide by 1 % and too fast by 0.3",
    ),
    (
        DRIVEN,
        "missed_between_steps",
        0.01,
        "the force rises and falls so fast in the steps or rows at the peak that",
    ),
    (with_numbers(DRIVEN, control__accuracy=0.03), "missed_between_steps", 0.03, "the force rises and falls so fast"),
    (AT_REST, "energy_j__kinetic", 1e-4, "the specimen still moves at the end: its kinetic energy is 1e-06"),
    (
        with_numbers(AT_REST, energy_j__elastic_blocks=0.0, energy_j__elastic_contacts=0.0),
        "energy_j__kinetic",
        2e-10,
        "the specimen still moves at the end: its kinetic energy is 1e-06",
    ),
    (AT_REST, "energy_j__area", 2.0, "re-detection of contacts that press changed"),
    (AT_REST, "energy_j__area", -2.0, "re-detection of contacts that press changed"),
    (REAL_TIME, "energy_j__redetection", 2.0, "re-detection of contacts that press changed"),
    (REAL_TIME, "energy_j__redetection", -2.0, "re-detection of contacts that press changed"),
    (
        with_numbers(DRIVEN, work_of_force_j=500.0),
        "energy_j__redetection",
        5.0,
        "re-detection of contacts that press changed",
    ),
    (
        with_numbers(DRIVEN, work_of_force_j=90.0),
        "energy_j__redetection",
        2.0,
        "re-detection of contacts that press changed",
    ),
    (
        with_numbers(DRIVEN, energy_j__area=-1.0),
        "energy_j__redetection",
        1.0,
        "re-detection of contacts that press changed",
    ),
    (REAL_TIME, "energy_j__damping", 2.0, "local damping took 1 % of the work"),
    (REAL_TIME, "energy_j__damping", -2.0, "local damping took 1 % of the work"),
    (SHAKEN, "rotation_max_rad", 0.1, "a block turned by 0.1 rad as the ground shook: near to overturning one history"),
    (SHAKEN, "shaking__kinetic_at_end", 0.01, "the specimen still moved at the end, with 1 % of its largest kinetic"),
    (GROWN, "collapse_load__swayed_over_block", 0.005, "blocks moved by up to 0.005 of the smallest one before it"),
    (
        with_numbers(GROWN, collapse_load__accuracy=0.002),
        "collapse_load__swayed_over_block",
        0.001,
        "blocks moved by up to 0.001 of the smallest one before it fell",
    ),
    (LOOPS, "collapse_load__swayed_over_block", 0.005, "blocks moved by up to 0.005 of the smallest one, but"),
    (with_numbers(LOOPS, collapse_load__accuracy=0.002), "damping_over_external", 0.02, "damping took 2 % of the work"),
    (LOOPS, "damping_over_external", 0.025, "damping took 2.5 % of the work of the load before any fall"),
    (LED, "collapse_load__branch__out_of_balance_max", 0.01, "behind the collapse motion took up to 1 % of the coll"),
    (
        with_numbers(LED, collapse_load__accuracy=0.03),
        "collapse_load__branch__out_of_balance_max",
        0.03,
        "behind the collapse motion took up to 3 % of the collapse factor, more than the accuracy beyond 20 mm",
    ),
]
"""A summary without a doubt, a number of it, that number's limit, and how the doubt begins."""


@pytest.mark.parametrize(("summary", "key", "limit", "words"), LIMITS)
def test_below_a_limit_nothing_is_said_and_above_it_exactly_its_doubt(summary, key, limit, words):
    below, above = (with_numbers(summary, **{key: share * limit}) for share in (0.99, 1.01))
    assert is_sound(below) and trust(below).endswith(", and the energy balance closes.")
    doubt = only_doubt(above)
    assert doubt.sentence.startswith(words)
    assert doubt.value > doubt.limit and 1.0 < doubt.excess < 1.02


def is_sound(summary: dict[str, Any]) -> bool:
    """Whether nothing is said against it, in data and in words."""
    judgement = judge(summary)
    assert (judgement.verdict == "sound") == (not judgement.doubts) == trust(summary).startswith("sound: ")
    return not judgement.doubts


def only_doubt(summary: dict[str, Any], verdict: str = "with care") -> Doubt:
    """The one doubt that there is, which the sentence names."""
    judgement = judge(summary)
    (doubt,) = judgement.doubts
    assert judgement.verdict == verdict and trust(summary) == f"{verdict}: {doubt.sentence}."
    return doubt


@pytest.mark.parametrize("summary", [DRIVEN, AT_REST, REAL_TIME, GROWN, LED, LOOPS])
@pytest.mark.parametrize(("taken", "doubted"), [(1.0198, False), (1.0202, True)])
def test_a_contact_may_take_two_hundredths_more_of_mode_2_than_its_law_has(summary, taken, doubted):
    summary = with_numbers(summary, mode_2_over_law=taken)
    assert is_sound(summary) != doubted
    if doubted:
        assert only_doubt(summary).sentence.startswith("a contact took 1.02 times the energy of mode II")


@pytest.mark.parametrize(
    ("summary", "numbers"),
    [
        (REAL_TIME, {"energy_j__kinetic": 50.0, "unbalanced_after_settling": None, "kinetic_after_settling": None}),
        (REAL_TIME, {"reaction_mismatch_max": 3.0, "kinetic_over_internal_max": 9.0, "damping_over_external": 0.9}),
        (REAL_TIME, {"unbalanced_after_settling": 1.0, "kinetic_after_settling": 1.0}),
        (REAL_TIME, {"damping_over_external": -0.9}),
        (DRIVEN, {"energy_j__kinetic": 50.0, "energy_j__damping": 90.0}),
        (GROWN, {"energy_j__kinetic": 50.0, "energy_j__damping": 90.0}),
        (GROWN, {"reaction_mismatch_max": 3.0, "kinetic_over_internal_max": 9.0, "damping_over_external": 0.9}),
        (GROWN, {"collapse_load__swayed_over_block": None}),
        (LED, {"collapse_load__branch__ends": "zero"}),
        (REAL_TIME, {"rotation_max_rad": 3.0}),
        (with_numbers(DRIVEN, law_by_group={"beds": "elastic", "heads": "elastic"}), {"rise_at_end": 0.1}),
    ],
)
def test_a_number_is_no_doubt_of_a_run_that_it_says_nothing_of(summary, numbers):
    assert is_sound(with_numbers(summary, **numbers))


@pytest.mark.parametrize(
    ("summary", "numbers", "words"),
    [
        (DRIVEN, {"energy_imbalance": None}, "the energy balance is not known"),
        (DRIVEN, {"reaction_mismatch_max": None}, "no force at drive or support was measured"),
        (DRIVEN, {"kinetic_over_internal_max": None}, "the kinetic energy is not known"),
        (DRIVEN, {"interrupted": True}, "the run was interrupted"),
        (DRIVEN, {"stopped": "unstable"}, "the run was stopped"),
        (DRIVEN, {"energy_j__area": None}, "there is no number of this energy: area"),
        (DRIVEN, {"energy_j__kinetic": float("inf")}, "there is no number of this energy: kinetic"),
        (AT_REST, {"came_loose": "block 1 came loose"}, "block 1 came loose: no joint that bears anything holds it"),
        (DRIVEN, {"met": "block 1 and block 2 meet"}, "block 1 and block 2 meet: nothing holds them apart"),
        (GROWN, {"collapse_load__falls": None}, "nothing fell up to the factor at which the load ends"),
        (GROWN, {"collapse_load__borne": 0.0}, "not the least part of the load was borne"),
        (
            GROWN,
            {"collapse_load__undecided": 1},
            "in 1 of the trials the specimen neither came to rest nor gathered speed",
        ),
        (GROWN, {"collapse_load__falls_by_turning": True}, "at the factor that is not borne a block turned by more"),
        (GROWN, {"collapse_load__later_m": 0.3}, "a bar that hangs slack bears what fell after about 300 mm"),
        (LED, {"collapse_load__branch__ends": "too far"}, "blocks had crushed, slid or met too far to go on where"),
        (LED, {"collapse_load__branch__leaps": 2}, "the specimen leapt ahead of gauge 'top' 2 times"),
        (LED, {"collapse_load__branch__ends": "stays"}, "the collapse hardly moves gauge 'top'"),
        (LED, {"collapse_load__branch__ends": "other way"}, "the collapse moves gauge 'top' away from limit.until"),
        (LED, {"collapse_load__branch__ends": "passed"}, "gauge 'top' read 0 mm before the fall"),
        (LED, {"collapse_load__branch__ends": "up_to"}, "the factor came to limit.up_to where gauge 'top' was at 50"),
        (LED, {"collapse_load__branch__ends": "runs away"}, "gauge 'top' could not be controlled: at 50 mm"),
        (LED, {"collapse_load__branch__ends": "turned"}, "a block turned by more than solver.rotation_limit where"),
        (LED, {"collapse_load__branch__ends": "late"}, "gauge 'top' came no further than 50 mm in 1000 steps"),
        (
            LOOPS,
            {"collapse_load__falls": 0.5, "collapse_load__borne": 0.0, "collapse_load__loops__leg": 1},
            "not the least part of the load was borne",
        ),
    ],
)
def test_what_has_no_limit_is_one_doubt(summary, numbers, words):
    ends = "stopped" if numbers.keys() & {"interrupted", "stopped"} else "with care"
    doubt = only_doubt(with_numbers(summary, **numbers), ends)
    assert doubt.sentence.startswith(words) and (doubt.limit is None or doubt.name == "undecided_trials")


@pytest.mark.parametrize("accuracy", [0.005, 0.03])
def test_a_load_that_rises_again_behind_the_collapse_is_a_doubt_beyond_twice_the_accuracy(accuracy):
    most = [1.01 * (1.0 + 2.0 * share * accuracy) for share in (0.99, 1.01)]
    numbers = {"collapse_load__accuracy": accuracy, "collapse_load__branch__out_of_balance_max": 0.0}
    below, above = (with_numbers(LED, collapse_load__branch__factor_max=factor, **numbers) for factor in most)
    assert is_sound(below) and only_doubt(above).name == "branch_rises"
    assert only_doubt(above).sentence.startswith("behind the collapse the load rises again, by ")


def test_a_leg_to_the_other_side_may_fall_at_once():
    assert is_sound(with_numbers(LOOPS, collapse_load__falls=0.5, collapse_load__borne=0.0))


def test_the_largest_doubt_comes_first_and_the_sentence_names_three():
    summary = with_numbers(DRIVEN, overlap_max=0.1, reaction_mismatch_max=0.1, rise_at_end=0.02, slip_max=5.0)
    assert [doubt.name for doubt in judge(summary).doubts] == ["slip", "overlap", "not_quasi_static", "still_rising"]
    assert trust(summary).startswith("with care: contacts slid") and trust(summary).endswith("; and 1 more.")
    first = judge(with_numbers(summary, interrupted=True))
    assert first.verdict == "stopped" and first.doubts[0].name == "interrupted"


def test_all_that_shows_a_fast_test_is_one_doubt_and_the_furthest_beyond_its_limit_comes_first():
    numbers = {"reaction_mismatch_max": 0.04, "kinetic_over_internal_max": 0.3, "control__drag_at_peak": 0.03}
    doubt = only_doubt(with_numbers(DRIVEN, damping_over_external=0.019, **numbers))
    assert (doubt.name, doubt.value, doubt.limit) == ("not_quasi_static", 0.3, 0.05)
    assert doubt.sentence == (
        "not quasi-static: the kinetic energy reaches 0.3 of the internal energy (should be under 0.05), and damping "
        "took 3 % of the force at the peak, which may be too high by as much, and the forces at drive and support "
        "differ by 0.04 of the peak (should be under 0.02)"
    )
    lacks = only_doubt(with_numbers(DRIVEN, reaction_mismatch_max=None, kinetic_over_internal_max=0.3))
    assert lacks.value == 0.3, "what is not known hides nothing"


def test_what_is_told_to_do_is_told_once():
    summary = with_numbers(DRIVEN, reaction_mismatch_max=0.1)
    (doubt,) = judge(summary).doubts
    summary |= judge(summary, [doubt._replace(name="another")]).as_keys()
    assert advice(summary) == ["load more slowly: ask for a smaller accuracy, or lower the rate", CONVERGE]
    assert CONVERGE not in advice(with_numbers(DRIVEN, overlap_max=0.1)), "no matter of resolution"
    assert not any(words in trust(summary) for words in advice(summary))


@pytest.mark.parametrize("summary", [DRIVEN, AT_REST, GROWN])
def test_what_was_not_measured_is_not_fine(summary):
    assert judge(summary).not_measured == ()
    lacking = with_numbers(summary, overlap_max=None, slip_max=float("nan"))
    assert judge(lacking).not_measured == ("overlap", "slip") and is_sound(lacking)


def test_a_summary_keeps_its_judgement_and_an_older_one_is_judged_when_it_is_read():
    summary = with_numbers(DRIVEN, overlap_max=0.1, warnings=["a warning of its own"])
    doubts = [doubt.name for doubt in judgement_of(summary).doubts]
    assert doubts == ["warning", "overlap"]
    kept = json.loads(json.dumps(summary | judge(summary).as_keys()))
    assert kept["doubts"][0].keys() == {"name", "value", "limit", "sentence", "advice", "resolution"}
    assert judgement_of(kept) == judge(summary)


def test_that_a_run_was_stopped_stands_before_what_is_not_known():
    summary = with_numbers(DRIVEN, stopped="unstable", kinetic_over_internal_max=None, reaction_mismatch_max=None)
    assert [doubt.name for doubt in judge(summary).doubts] == ["stopped", "not_quasi_static"]
    words = judge(summary).doubts[1].sentence
    assert words.startswith("no force at drive or support") and words.endswith("; the kinetic energy is not known")


@pytest.mark.parametrize(
    "changes",
    [
        {"doubts": 5},
        {"doubts": "overlap"},
        {"doubts": [{}]},
        {"doubts": [{"name": ["x"], "value": "1", "limit": None, "sentence": None}]},
        {"doubts": []},
        {"verdict": "great"},
        {"verdict": "sound"},
        {"verdict": ["sound"]},
        {"not_measured": None},
    ],
)
def test_a_judgement_that_cannot_be_read_is_made_again(changes):
    summary = with_numbers(DRIVEN, overlap_max=0.1)
    assert judgement_of(summary | judge(summary).as_keys() | changes) == judge(summary)


@pytest.mark.parametrize("other", ["abc", 5, [1], {"a": 1}, True, [], {}, None])
@pytest.mark.parametrize("key", ["overlap_max", "energy_j", "reactions", "collapse_load", "control", "warnings"])
def test_a_summary_with_something_else_at_a_key_is_judged_by_the_others(key, other):
    summary = with_numbers(DRIVEN, stopped="unstable") | {key: other}
    assert judgement_of(summary).verdict == "stopped" and trust(summary)


def test_each_criterion_has_a_name_and_a_file_of_its_own_room():
    names = [criterion.name for criterion in criteria()]
    assert len(names) == len(set(names)) > 30
