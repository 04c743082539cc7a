"""`cells` in a scene: what may be asked of a division, where it is told what is wrong, and what the report says."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.cells.request import CellRequest
from geometry.polyhedra.construct import from_boxes
from geometry.specimens import stacked
from masonry.assembly.specimens import specimen_of
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.laboratory.text import check_text
from masonry.scene import load

MESO = "couplet-meso-coarse"


def asked(*overrides, name="wallette-mode-1-218"):
    return load(name, list(overrides)).specimen.cells


@pytest.mark.parametrize("name", ["wallette-mode-1-218", "wallette-mode-2-335", "wallette-mode-1-540"])
def test_the_walls_have_the_number_of_blocks_of_the_paper_exactly(name):
    specimen = specimen_of(load(name))
    assert len(specimen.sets["units"]) == int(name[-3:]) == specimen.cells[0].count
    assert specimen.cells[0].shortest_over_mean >= 0.35
    assert (specimen.cells[0].small_edges, specimen.cells[0].size_error < 0.01) == (0.0, True)


def test_the_beds_of_the_couplets_have_the_number_of_cells_that_their_scene_asks_for():
    for name, count in ((MESO, 100), ("couplet-meso-medium", 300)):
        specimen = specimen_of(load(name))
        assert len(specimen.sets["mortar"]) == count
        assert specimen.cells[0].shortest_over_mean >= 0.35


def test_every_key_of_cells_reaches_the_division(monkeypatch):
    """Whatever a scene asks for stands in what the geometry is asked for."""
    heard = []

    def fill(low, high, asked, group):
        heard.append(asked)
        return from_boxes(low, high, np.arange(len(low)), np.zeros(len(low)), (group,)), None

    monkeypatch.setattr(stacked, "fill_with_cells", fill)
    sites = [["50 mm", "2 mm", "55 mm"], ["100 mm", "2 mm", "58 mm"]]
    cells = {"total": 2, "kind": "voronoi", "form": "space", "seed": 9, "regularise": False, "sites": sites}
    for table in (cells, {"per_unit": 2, "sizes": [1.0, 2.0]}, {"size": "5 mm", "spread": 0.3}):
        specimen_of(load(MESO, {"specimen.mortar.cells": table, "assumptions": {}}))
    places = ((0.05, 0.002, 0.055), (0.1, 0.002, 0.058))
    assert heard == [
        CellRequest(total=2, laguerre=False, space=True, seed=9, regularise=False, sites=places),
        CellRequest(per_unit=2, sizes=(1.0, 2.0)),
        CellRequest(size=0.005, spread=0.3),
    ]


def test_another_seed_gives_other_cells_of_the_same_number():
    one, two = (specimen_of(load("wallette-mode-1-218", [f"specimen.cells.seed={seed}"])) for seed in (1, 2))
    assert one.blocks.count == two.blocks.count
    assert one.blocks.points.shape != two.blocks.points.shape or (one.blocks.points != two.blocks.points).any()


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("specimen.cells.total=0", "--set specimen.cells.total: "),
        ("specimen.cells.total=1.5", "whole number"),
        ("specimen.cells.kind=hexagon", "'hexagon' is not allowed; allowed: laguerre, voronoi"),
        ("specimen.cells.form=spaces", "did you mean 'space'? allowed: plane, space"),
        ("specimen.cells.regularise=1", "must be true or false, not '1'"),
        ("specimen.cells.spread=-1", "--set specimen.cells.spread: "),
        ("specimen.cells.sedd=5", "unknown key; did you mean 'seed'? allowed: total, per_unit, size, kind"),
        ("specimen.cells.sites=[['1 mm', '1 mm', '1 mm']]", "there are 1 sites; write total = 1"),
        ("specimen.cells={}", "exactly one of total, per_unit, size says how many cells, not none"),
        ("specimen.cells={total=5, size='1 mm'}", "not total and size"),
        ("specimen.cells={per_unit=5, sizes=[1, 2]}", "there are 2 sizes for 5 cells per unit"),
        ("specimen.cells={per_unit=2, sizes=[1, 2], spread=0.1}", "spread and sizes both say how large"),
        ("specimen.cells={per_unit=2, sizes=[1, 0]}", "sizes must be in (0, "),
        ("specimen.cells={total=20, kind='voronoi', spread=0.1}", "kind = 'laguerre' takes sizes"),
    ],
)
def test_what_cannot_be_asked_of_cells_is_told(override, words):
    with pytest.raises(SceneError) as error:
        asked(override)
    assert words in str(error.value)
    assert str(error.value).startswith("--set specimen.cells")
    assert "\n" not in str(error.value)


def test_a_grid_and_cells_exclude_each_other():
    with pytest.raises(SceneError, match="divisions and cells exclude each other; leave divisions out"):
        asked("specimen.divisions=[8, 4]", "specimen.cells.total=200")
    with pytest.raises(SceneError, match="mortar.*divisions and cells exclude each other"):
        load(MESO, ["specimen.mortar.divisions=[8, 1, 4]", "specimen.mortar.cells.total=200"])


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("specimen.cells.size=0.01 mm", r"specimen\.cells: this would make about 2.* blocks"),
        ("specimen.cells={per_unit=2, sizes=[1e-9, 1]}", "sizes run from 1e-09 to 1; the largest may be 1e.06 times"),
        ("specimen.cells.total=9", "total is 9, but there are 10 units; nearest: 10"),
    ],
)
def test_too_many_and_too_few_cells_are_refused_before_anything_is_built(override, words):
    with pytest.raises((SceneError, GeometryError), match=words):
        laboratory.check(load("wallette-mode-1-218", [override]))


def test_check_says_in_a_line_what_the_cells_came_to():
    report = laboratory.check(load(MESO))
    assert len(report["cells"]) == 1
    for words in ("100 of h = 5.48 mm", "of the mean, 0.0% small, sizes within 0.0%"):
        assert words in report["cells"][0]
    line = next(line for line in check_text(report).splitlines() if line.startswith("cells"))
    assert report["cells"][0] in line


def test_the_summary_and_the_log_hold_what_the_cells_came_to():
    overrides = ["drive.steps=20", "settle.steps=10", "solver.rows=2"]
    result = laboratory.run(load(MESO, overrides))
    cells = result.summary["cells"]
    assert [entry["count"] for entry in cells] == [100]
    assert cells[0]["h"] == pytest.approx((0.2 * 0.015 / 100) ** 0.5)
    assert any(line.startswith("cells: 100 of h") for line in result.log)
