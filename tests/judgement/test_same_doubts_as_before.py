"""Whatever a summary holds or lacks: what the one sentence of trust said before is what criteria of their own doubt."""

import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from masonry.judgement.evidence import Evidence
from masonry.judgement.judgement import judge
from tests.judgement.summaries import AT_REST, DRIVEN, GROWN, LED, LOOPS, REAL_TIME, with_numbers
from tests.judgement.trust_before import trust as trust_before

BEFORE = {
    "interrupted": ("interrupted",),
    "the run was stopped": ("stopped",),
    "energy balance is": ("energy_balance",),
    "laws and contacts disagree": ("dissipation",),
    "no number of this energy": ("energy_numbers",),
    "local damping took": ("local_damping",),
    "the dead loads had not come to rest": ("unbalanced_after_settling", "kinetic_after_settling"),
    "m had not come to rest under": ("unbalanced_block", "kinetic_block"),
    "the specimen still moves": ("motion_at_end",),
    "m still moves at the end": ("block_at_end",),
    "nothing fell up to": ("nothing_fell",),
    "not the least part": ("nothing_borne",),
    "trials the specimen neither": ("undecided_trials",),
    "at the factor that is not borne": ("falls_by_turning",),
    "blocks moved by up to": ("sway",),
    "it was not led on": ("branch_end",),
    "came to limit.up_to": ("branch_end",),
    "could not be controlled": ("branch_end",),
    "short of limit.until: ": ("branch_end",),
    "came no further than": ("branch_end",),
    "leapt ahead": ("branch_leaps",),
    "behind the collapse motion took": ("branch_balance",),
    "forces and moments add up": ("force_balance",),
    "contacts close by": ("overlap",),
    "found anew": ("redetection",),
    "energy of mode II": ("mode_2_energy",),
    "contacts slid by": ("slip",),
    "nothing holds them apart": ("meeting",),
    "sudden cracks released": ("sudden_cracks",),
    "damping added": ("damping_gain",),
    "before any fall": ("damping_before_fall",),
    "of the force at the peak": ("drag_at_peak",),
    "reaction_mismatch_max is not known": ("reaction_mismatch",),
    "the two ends differ": ("reaction_mismatch",),
    "kinetic_over_internal_max is not known": ("kinetic_energy",),
    "kinetic energy reaches": ("kinetic_energy",),
    "damping takes": ("damping",),
}
"""Words of the sentence before, and the criteria of which one at least must now doubt; no others may."""
UNKNOWN = ("reaction_mismatch_max is not known", "kinetic_over_internal_max is not known")
LIMITS = {
    "energy_imbalance": 1e-9,
    "dissipation_mismatch": 0.01,
    "force_balance": 1e-9,
    "overlap_max": 0.01,
    "mode_2_over_law": 1.02,
    "slip_max": 0.05,
    "released_over_dissipated": 0.01,
    "damping_over_external": 0.02,
    "reaction_mismatch_max": 0.02,
    "kinetic_over_internal_max": 0.05,
    "unbalanced_after_settling": 1e-3,
    "kinetic_after_settling": 1e-6,
    "work_of_force_j": 300.0,
    "energy_j__kinetic": 1e-4,
    "energy_j__damping": 2.0,
    "energy_j__area": 1.0,
    "energy_j__redetection": 2.0,
}
"""May be missing, null or no number as well."""
ALWAYS = {
    "unrest_after_settling__unbalanced": 1e-2,
    "unrest_after_settling__kinetic": 1e-4,
    "moving_at_end__kinetic": 1e-4,
    "control__drag_at_peak": 0.01,
}
GROWING = {"collapse_load__swayed_over_block": 0.005}
BRANCH = {"collapse_load__branch__out_of_balance_max": 0.01}
ACCURACY = st.sampled_from([0.002, 0.01, 0.03])
WORDS = {"interrupted": True, "stopped": "unstable", "met": "block 1 and block 2 meet"}
ENDS = ("until", "zero", "stays", "other way", "passed", "up_to", "runs away", "turned", "late")


def near(limit: float) -> st.SearchStrategy[float]:
    """At a limit, on either side of it, and far from it, of both signs."""
    times = st.sampled_from([0.0, 0.5, 0.99, 1.0, 1.01, 2.0, 1e3, -0.5, -0.99, -1.0, -1.01, -30.0])
    return st.one_of(times.map(lambda times: times * limit), st.floats(-3.0, 3.0).map(lambda times: times * limit))


def some(limits: dict[str, float], nothing: bool) -> st.SearchStrategy[dict[str, Any]]:
    """Numbers for some keys of a table of limits."""
    none = st.sampled_from([None, math.nan]) if nothing else st.nothing()
    return st.fixed_dictionaries({}, optional={key: st.one_of(near(limit), none) for key, limit in limits.items()})


@st.composite
def summaries(draw: st.DrawFn) -> dict[str, Any]:
    base = draw(st.sampled_from([DRIVEN, AT_REST, REAL_TIME, GROWN, LED, LOOPS]))
    numbers = draw(some(LIMITS, nothing=True)) | draw(some(ALWAYS, nothing=False))
    numbers["slip_limit"] = draw(st.sampled_from([None, math.nan, 0.0, 0.25, 0.5]))
    numbers["control__accuracy"] = draw(ACCURACY)
    if "collapse_load" in base:
        numbers["collapse_load__accuracy"] = draw(ACCURACY)
        numbers |= draw(some(GROWING, nothing=False))
        numbers["collapse_load__undecided"] = draw(st.integers(0, 2))
        numbers["collapse_load__falls_by_turning"] = draw(st.booleans())
        numbers["collapse_load__borne"] = draw(st.sampled_from([0.0, 1.0]))
        numbers["collapse_load__falls"] = draw(st.sampled_from([None, 1.01]))
    if base is LED:
        numbers |= draw(some(BRANCH, nothing=False))
        numbers["collapse_load__branch__ends"] = draw(st.sampled_from(ENDS))
        numbers["collapse_load__branch__leaps"] = draw(st.integers(0, 2))
    numbers |= {key: value for key, value in WORDS.items() if draw(st.integers(0, 9)) == 0}
    summary = with_numbers(base, **numbers)
    for key in draw(st.sets(st.sampled_from(sorted(summary.keys() - {"collapse_load", "reactions"})), max_size=4)):
        del summary[key]
    return summary


def as_filed(value: Any) -> Any:
    """As a file has it, in which what is no number is null: the sentence before said otherwise of the same run before
    it was filed."""
    if isinstance(value, dict):
        return {key: as_filed(below) for key, below in value.items()}
    return None if isinstance(value, float) and math.isnan(value) else value


@settings(max_examples=1000, deadline=None)
@given(summaries())
def test_the_same_doubts_are_raised_as_the_one_sentence_had(summary):
    try:
        sentence = trust_before(as_filed(summary))
    except ZeroDivisionError:  # damping without any work
        return
    driven = Evidence(summary).has_drive  # without a drive these are not measured, which was a doubt before
    expected = [names for words, names in BEFORE.items() if words in sentence and (driven or words not in UNKNOWN)]
    judgement = judge(summary)
    raised = {doubt.name for doubt in judgement.doubts}
    assert all(raised & set(names) for names in expected)
    assert raised <= {name for names in expected for name in names}
    clean = not expected and not summary.get("warnings")
    assert (judgement.verdict == "sound") == (clean if not driven else not sentence.startswith("with care"))
    assert (judgement.verdict == "stopped") == bool(summary.get("interrupted") or summary.get("stopped"))


@pytest.mark.parametrize("summary", [DRIVEN, AT_REST, REAL_TIME, GROWN, LED, LOOPS])
def test_no_word_of_the_sentence_before_is_in_what_was_clean(summary):
    assert not any(words in trust_before(summary) for words in BEFORE if words != "energy balance is")
