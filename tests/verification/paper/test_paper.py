"""The paper's experiments: their runs can be read, what is unsound is named, and what is varied acts as it should."""

from pathlib import Path

import pytest

from masonry import scene
from masonry.errors import SceneError
from tests.results.sample import sample
from verification.paper import catalogue, command, gathering, page
from verification.paper.experiment import (
    ACCURACY,
    COARSER,
    Claim,
    Done,
    Experiment,
    Missing,
    Run,
    Section,
    Shown,
    claim,
)
from verification.paper.experiments import sensitivity
from verification.paper.soundness import soundness
from verification.paper.variations import assumed, options

EXPERIMENTS = catalogue.catalogue()
SOUND = {"status": "OK", "reason": "", "seconds": 1.0, "energy_imbalance": 1e-14, "reaction_mismatch_max": 0.001}


@pytest.mark.parametrize("quick", [False, True], ids=["full", "quick"])
@pytest.mark.parametrize("name", EXPERIMENTS)
def test_every_run_of_the_paper_is_a_scene_that_can_be_read(name, quick):
    runs = gathering.with_coarser(gathering.paced(EXPERIMENTS[name].runs(quick), quick))
    assert runs
    for run in runs.values():
        assert scene.load(run.scene, run.settings).name == run.scene


def test_a_claim_says_why_only_where_it_does_not_hold_and_parts_numbers_from_percent_signs():
    held = claim("it holds", "1", "within 5%", "3.1%", True, "nothing")
    assert (held.check, held.measured, held.why) == ("within 5 %", "3.1 %", "")
    assert claim("lost", "1", "-", "-", None, "10% are lost").why == "10 % are lost"
    with pytest.raises(ValueError, match="say why"):
        claim("it fails", "1", "-", "-", False)


def test_a_quick_look_asks_for_fewer_runs_than_the_whole():
    for experiment in EXPERIMENTS.values():
        assert len(experiment.runs(True)) <= len(experiment.runs(False))


def test_runs_that_ask_for_it_are_made_again_at_twice_the_loading_error_and_a_quick_look_is_content_with_more():
    runs = {"a": Run("couplet", pace_check=True), "b": Run("couplet", {"drive.rate": "1 mm/s"})}
    full = gathering.with_coarser(gathering.paced(runs, quick=False))
    assert full["a"] == runs["a"] and full["b"] == runs["b"]
    assert full[COARSER.format("a")].settings == {ACCURACY: "2 %"} and len(full) == 3
    assert Run("couplet", {ACCURACY: "0.6 %"}, pace_check=True).finer() == Run("couplet", {ACCURACY: "0.3 %"}, True)
    quick = gathering.paced(runs, quick=True)
    assert quick["a"].settings == {ACCURACY: "4 %"} and quick["b"] == runs["b"]


def test_a_run_is_made_again_with_half_the_error_as_long_as_its_ends_differ_or_twice_the_error_moves_its_peak(
    tmp_path, monkeypatch
):
    """The ends of `apart` differ by 1.5 times its accuracy, the peak of `moves` by 0.9 times; a rate stays as it is."""
    runs = {
        "apart": Run("couplet", {ACCURACY: "2 %"}),
        "moves": Run("couplet", pace_check=True),
        "rate": Run("couplet", {"drive.rate": "1 mm/s"}),
        "own": Run("couplet", {ACCURACY: "4 %"}, own_pace=True),
    }
    made = []

    def row(job):
        error = 0.01 * Run(job.scene, job.settings).percent
        made.append((job.label, error))
        ends = 1.5 * error if job.label.startswith("apart") else 0.9 if job.label in ("rate", "own") else 0.0
        return SOUND | {"reaction_mismatch_max": ends, "peak_stress_pa": 1e6 * (1.0 + 1.5 * error)}

    monkeypatch.setattr(gathering.engine, "run", lambda jobs, *_: [row(job) for job in jobs])
    experiment = Experiment("x", "X", 1, lambda quick: runs, lambda done: Section())
    [done] = gathering.results([experiment], tmp_path, False, 1, None)
    assert done.runs["apart"].percent == 1.0 and done.runs["moves"].percent == 0.5
    assert done.runs["rate"] == runs["rate"] and done.runs["own"] == runs["own"]
    assert done.refined == {"apart", "moves"} and done.runs[COARSER.format("moves")].percent == 1.0
    assert ("moves", 0.25 * 0.01) not in made, "no finer than needed"
    *_, ends, moved = soundness(done)
    assert "rate" in ends.why and "apart" not in ends.why and "2 were made again" in ends.check
    assert moved.holds and COARSER.format("moves") not in ends.why


def test_a_run_whose_ends_disagree_or_whose_energy_is_lost_is_named(tmp_path):
    runs = {"fine": Run("couplet"), "wild": Run("couplet"), "gone": Run("couplet")}
    rows = {"fine": SOUND, "wild": SOUND | {"reaction_mismatch_max": 0.05, "energy_imbalance": 1e-3}}
    rows["gone"] = {"status": "STOPPED", "reason": "block 3 turned"}
    came, energy, ends = soundness(Done(runs, rows, tmp_path))
    assert not came.holds and "gone (block 3 turned)" in came.why
    assert not energy.holds and "wild" in energy.why and "fine" not in energy.why
    assert not ends.holds and "5 %" in ends.measured
    assert all(c.holds for c in soundness(Done({"fine": Run("couplet")}, {"fine": SOUND}, tmp_path)))


def test_ends_of_a_sudden_break_are_compared_before_its_peak_and_those_of_any_other_run_to_its_end(tmp_path):
    result = sample()
    rows, peak = result.history.rows, int(result.history.rows["stress"].argmax())
    rows["support_stress"] = rows["stress"] * 1.01
    rows["support_stress"][peak:] = 0.0
    for sudden, holds in (("it breaks", True), ("", False)):
        runs = {"a": Run("couplet", sudden=sudden)}
        found = {"a": SOUND | {"reaction_mismatch_max": 0.9}}
        ends = soundness(Done(runs, found, tmp_path, loaded={"a": result}))[2]
        assert ends.holds is holds
    rows["support_stress"][peak - 1] = 0.9 * rows["stress"][peak - 1]
    runs = {"a": Run("couplet", sudden="it breaks")}
    assert not soundness(Done(runs, found, tmp_path, loaded={"a": result}))[2].holds


def test_a_claim_that_does_not_hold_needs_a_reason():
    with pytest.raises(ValueError, match="say why"):
        Claim("it holds", "1", "nothing", "0", False)


def test_an_experiment_without_its_runs_says_so_and_does_not_hold():
    def show(done: Done) -> Section:
        raise Missing("'a' ended as REFUSED: no such block")

    experiment = Experiment("x", "X", 1, lambda quick: {"a": Run("couplet")}, show)
    rows = {"a": {"status": "REFUSED", "reason": "no such block", "seconds": None}}
    made = gathering.shown(experiment, Done(experiment.runs(False), rows, Path()))
    assert not made.section.claims[0].holds and "no such block" in made.section.claims[0].why
    assert page.verdict([made]).kind == "bad"


def test_the_verdict_counts_what_holds_and_the_page_gives_the_reason_of_what_does_not():
    claims = [Claim("a", "1", "x < 1", "0", True), Claim("b", "2", "x < 1", "2 <MPa>", False, "because of & c")]
    made = Shown(Experiment("x", "X", 1, lambda quick: {}, lambda done: Section()), Section([], claims), [], 1.0, 0)
    assert "Of 2 claims 1 hold, 1 do not" in page.verdict([made]).sentence and page.verdict([made]).kind == "warn"
    text = page.html_of([made], 1.0, quick=False)
    assert "because of &amp; c" in text and "2 &lt;MPa&gt;" in text and "http" not in text.partition("<body>")[2]
    assert text.count("because of &amp; c") == 1, "a claim stands on the page once"
    assert text.count(f'href="#{page.CLAIMS}-x"') == 1 and text.count(f'id="{page.CLAIMS}-x"') == 1
    assert page.REFERENCE in text
    assert '<td data-name="verdict" class="bad">' in text, "the name of the column, for screens too narrow for it"


def test_the_end_of_dilation_is_varied_once_where_it_is_assumed_and_as_an_option_elsewhere():
    ends = [v for v in assumed("wallette-mode-1")[0] if v.entry == "contact.unit_unit.dilation_cutoff"]
    assert [v.label for v in ends] == ["x0.4", "x2", "x4", "x9.2"]
    assert not [v for v in options("wallette-mode-1") if v.entry == "dilation_cutoff"]
    assert [v for v in options("wallette-mode-2") if v.entry == "dilation_cutoff"]


@pytest.fixture(scope="module")
def varied(tmp_path_factory) -> Section:
    """The couplet with its residual cohesion and its path varied."""

    def few(case, quick):
        return [
            v for v in sensitivity.assumed("couplet")[0] if v.entry.endswith(("residual_cohesion", "placement"))
        ], {}

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sensitivity, "variations", few)
        patch.setattr(sensitivity, "PACE", {"couplet": sensitivity.PACE["couplet"]})
        made = gathering.gather([sensitivity.EXPERIMENT], tmp_path_factory.mktemp("paper"), workers=1)
    assert all(claim.holds for claim in made[0].soundness)
    return made[0].section


def test_residual_cohesion_lifts_the_final_stress_by_itself_and_leaves_the_peak(varied):
    found = {(r["quantity"], r["knob"].split(".")[-1], r["rung"]): r for r in varied.records}
    final = found["final", "residual_cohesion", "50 kPa"]
    assert final["value"] - final["reference"] == pytest.approx(50e3, rel=0.02)
    assert abs(found["peak", "residual_cohesion", "50 kPa"]["error"]) < 1e-3
    assert found["dissipated", "displacement", "x1.2"]["error"] > 0.02  # friction goes on
    assert varied.verdicts[0].kind == "warn" and "residual_cohesion in couplet" in varied.verdicts[0].sentence


def test_the_command_names_the_nearest_experiment_and_lists_them(capsys):
    with pytest.raises(SceneError, match="did you mean 'sensitivity'"):
        command.main(["sensitivty"])
    assert command.main(["--list"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == list(EXPERIMENTS)
