"""The stability map: what a cell is called, that nothing wrong passes in silence, and that the page says it."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from verification import report
from verification.html.page import Chapter
from verification.scene_runs import SceneRun, joint_of, load
from verification.stability import falling, maps, motion
from verification.stability.cells import GOOD, KINDS, POOR, STATUSES, CellOutcome, Exact, Grid, MapCell
from verification.stability.maps import judged
from verification.stability.references import sheared
from verification.stability.scenes import CHAIN, COUPLET
from verification.studies import stability

SOUND = {"energy_imbalance": 0.0, "reaction_mismatch_max": 0.0, "kinetic_over_internal_max": 0.0}


def made(status="OK", reason="", **summary) -> SceneRun:
    return SceneRun("couplet", {}, status=status, reason=reason, summary={**SOUND, **summary})


def mapped(blocks_fall: bool) -> dict[str, list[CellOutcome]]:
    """The quick maps of blocks that fall, or of all else."""
    titles = {make(False).title for make in falling.GRIDS}
    grids = [grid for grid in maps.all_grids(full=False) if (grid.title in titles) == blocks_fall]
    return {grid.title: maps.run(grid) for grid in grids}


def assert_right(outcomes: dict[str, list[CellOutcome]]) -> None:
    wrong = [
        f"{t}: {o.row}, {o.column}: {o.reason}" for t, all_of in outcomes.items() for o in all_of if o.kind == "bad"
    ]
    assert not wrong, "\n".join(wrong)


@pytest.fixture(scope="module")
def quick():
    return mapped(blocks_fall=False)


def test_what_is_wrong_without_a_word_is_bad_and_what_says_so_is_not():
    assert judged(made(), 0.5 * GOOD)[0::2] == ("OK", "ok")
    assert judged(made(), 0.5 * POOR)[0::2] == ("OK", "warn")
    assert judged(made(), 2 * POOR)[0::2] == ("WRONG", "bad")
    assert judged(made(), math.nan)[0::2] == ("NOT FINITE", "bad")
    status, reason, kind = judged(made(reaction_mismatch_max=0.5), 2 * POOR)
    assert (status, kind) == ("WARNED", "warn") and "quasi-static" in reason


def test_a_stop_must_name_step_and_block_or_contact_and_a_refusal_must_give_a_reason():
    good = "unstable at step 7: rigid block 1 runs away"
    assert judged(made("STOPPED", good), math.nan)[2] == "stop"
    assert judged(made("STOPPED", "unstable"), math.nan)[2] == "bad"
    assert judged(made("STOPPED", "step 7: it broke"), math.nan)[2] == "bad"
    assert judged(made("REFUSED", ""), math.nan)[2] == "bad"
    assert judged(made("NOT FINITE", "NaN"), math.nan)[2] == "bad"


def test_a_cell_that_must_be_refused_and_is_not_is_bad_however_right_it_looks():
    assert judged(made(), 0.0, ("REFUSED",))[2] == "bad"
    assert judged(made("REFUSED", "no"), math.nan, ("OK",))[2] == "bad"


def test_an_error_is_relative_to_its_scale_and_infinite_without_one():
    assert Exact(1.1, 1.0).error == pytest.approx(0.1)
    assert Exact(0.1, 0.0, 2.0).error == pytest.approx(0.05)
    assert math.isinf(Exact(0.1, 0.0).error)


def test_no_cell_of_the_quick_map_is_wrong_without_a_word(quick):
    assert_right(quick)
    statuses = {o.status for all_of in quick.values() for o in all_of}
    assert statuses <= set(STATUSES) and {"OK", "WARNED", "REFUSED", "STOPPED"} <= statuses


@pytest.mark.slow
def test_no_cell_of_the_quick_maps_of_blocks_that_fall_is_wrong_without_a_word():
    assert_right(mapped(blocks_fall=True))


def test_every_cell_leaves_a_record_with_finite_numbers_and_its_reason(quick):
    for all_of in quick.values():
        for outcome in all_of:
            assert outcome.records
            for record in outcome.records:
                assert record["status"] == outcome.status and record["reason"] == outcome.reason
                json.dumps(record, allow_nan=False)
                assert "/" not in record["case"]


def test_the_full_map_has_the_quick_one_within_it_and_spans_what_is_asked():
    full = {grid.title: grid for grid in maps.all_grids(full=True)}
    for grid in maps.all_grids(full=False):
        assert set(grid.cells) <= set(full[grid.title].cells), grid.title
    assert {"1e+06", "1e+15"} <= set(full["Stiffness of the joint"].columns)
    assert {"1", "10000"} <= set(full["Stiffness of the joint"].rows)
    assert "1e+06" in full["Size of the blocks"].columns
    assert "1000" in full["Slivers"].columns
    assert {"0.001", "100000"} <= set(full["Density"].columns)
    assert "0.4999" in full["Poisson's ratio of tets"].columns
    assert {"0.1", "1.2"} <= set(full["Time step over the proven bound"].columns)
    assert {"x1", "x1000"} <= set(full["Rate"].columns)
    assert {"0 MPa", "100 MPa"} <= set(full["Confinement"].columns)
    assert {"0.1", "10000"} <= set(full["Fracture energy in shear"].columns)
    assert "1e+07" in full["Ten million steps"].columns


def test_the_limit_of_the_chain_is_the_largest_frequency_of_its_stiffness_matrix():
    loaded = load(CHAIN, motion.REAL)
    n, k = motion.BLOCKS - 2, loaded.contact["unit_unit"].normal_stiffness * 0.01
    mass = loaded.material["units"].density * 1e-3
    matrix = k / mass * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    assert motion.limit_of_chain(motion.REAL, 0.0) == pytest.approx(2 / math.sqrt(np.linalg.eigvalsh(matrix)[-1]))


def test_a_changed_reference_is_noticed():
    """The closed form takes its numbers from the scene: with 2 % more energy in the scene alone, it fails."""
    one = SceneRun(COUPLET, {"drive.steps": 4000})
    one.summary = laboratory.run(scene.load(COUPLET, one.knobs)).summary
    assert max(exact.error for exact in sheared(one).values()) < 1e-3
    more = 1.02 * joint_of(COUPLET, {}).G_II
    one.knobs = {**one.knobs, "contact.unit_unit.fracture_energy_mode_2": f"{more!r} N/m"}
    assert max(exact.error for exact in sheared(one).values()) > 2e-3


def test_the_map_has_a_field_for_every_cell_in_its_colour_with_its_error_and_what_is_not_ok(quick):
    grid = next(g for g in maps.all_grids(full=False) if g.title == "Confinement")
    outcomes = {(outcome.row, outcome.column): outcome for outcome in quick["Confinement"]}
    table = stability.map_of(grid, quick["Confinement"])
    fields = re.findall(r'<td class="(\w+)">([^<]*)(?:<small>([^<]*)</small>)?</td>', table)
    assert len(fields) == len(grid.cells) == len(outcomes)
    assert [kind for kind, *_ in fields] == [outcomes[row, column].kind for row in grid.rows for column in grid.columns]
    words = " ".join(word for _, *both in fields for word in both)
    assert "refused" in words and "stopped" in words and "%" in words
    assert table.count("<th>") == 1 + len(grid.columns)
    assert [stability.written(x) for x in (0.0, 0.012, 3e-13)] == ["0", "1.2 %", "3e-13"]


def test_the_chapter_shows_each_map_and_tells_the_reasons():
    cells = {("row", name): MapCell(COUPLET, {"drive.steps": 4000, **knobs}, sheared) for name, knobs in (
        ("fine", {}), ("refused", {"solver.damping": 1.0}))}  # fmt: skip
    chapter = stability.chapter(lambda _: None, [Grid("Made up", "a", "b", cells)])
    assert isinstance(chapter, Chapter) and chapter.verdicts[0].kind == "ok"
    page = "".join(chapter.parts)
    assert page.count("<table") == 2 and "damping must be in" in page
    assert not re.search(r"\bnan\b", page)


def test_every_kind_of_outcome_has_a_colour_on_the_page():
    template = (Path(report.__file__).parent / "template.html").read_text(encoding="utf-8")
    assert all(f"td.{kind} {{ background" in template for kind in KINDS)


def test_a_run_whose_contacts_close_too_far_says_so():
    soft = {"contact.unit_unit.normal_stiffness": "1e8 Pa/m", "drive.steps": 500}
    summary = laboratory.run(scene.load(COUPLET, soft)).summary
    assert summary["overlap_max"] == pytest.approx(0.5e6 / 1e8 / 0.05, rel=1e-3)
    assert "close by up to 0.1 of a block's size" in trust(summary)
    usual = laboratory.run(scene.load(COUPLET, {"drive.steps": 500})).summary
    assert usual["overlap_max"] == pytest.approx(0.5e6 / 150e9 / 0.05, rel=1e-3)
    assert usual["warnings"] == []


def test_a_run_beyond_the_proven_bound_says_so_even_where_it_ends_well():
    summary = laboratory.run(scene.load(COUPLET, {"drive.steps": 500, "solver.step_fraction": 1.05})).summary
    assert any("proven bound" in warning for warning in summary["warnings"])
    assert "proven bound" in trust(summary)


@pytest.mark.parametrize(("ratio", "kinematics", "warned"), [(0.35, "tets", 1), (0.3, "tets", 0), (0.49, "rigid", 0)])
def test_tets_that_lock_are_warned_of_where_no_run_is_off_by_five_percent_without_a_word(ratio, kinematics, warned):
    knobs = {"kinematics": kinematics, "specimen.mesh": "fan", "material.units.poisson_ratio": ratio}
    report = laboratory.check(scene.load(COUPLET, knobs))["warnings"]
    assert len(report) == warned and all("lock" in words for words in report)


@pytest.mark.parametrize("value", ["1e-300", "1e300"])
@pytest.mark.parametrize("key", ["normal_stiffness", "shear_stiffness"])
def test_numbers_that_no_float_can_carry_through_a_run_are_refused_with_their_range(key, value):
    with pytest.raises(SceneError, match=f"{key}.*1e"):
        scene.load(COUPLET, {f"contact.unit_unit.{key}": f"{value} Pa/m"})
