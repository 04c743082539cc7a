"""The tutorial runs from its first cell to its last in a kernel, and its numbers are those of the closed forms."""

import json
import re
from pathlib import Path

import pytest

from verification.references.closed_forms import Joint, shear

TUTORIAL = Path(__file__).resolve().parents[2] / "docs" / "tutorial.md"
LOOK = """
import json
print(json.dumps({
    "peak": result.peak.stress,
    "peaks": {law: found.peak.stress for law, found in laws.items()},
    "residuals": {law: found.summary["final_stress_pa"] for law, found in laws.items()},
    "slope": slope,
    "cohesion": 1e6 * cohesion,
    "imbalance": result.summary["energy_imbalance"],
    "walls": [found.peak.stress for found in looks.values()],
}))
"""
COMPRESSION, MOVED = 0.5e6, 1e-3


@pytest.fixture(scope="module")
def notebook(tmp_path_factory):
    """The tutorial, executed in an empty folder by a kernel of the interpreter that runs the tests."""
    jupytext, nbclient, nbformat = map(pytest.importorskip, ("jupytext", "nbclient", "nbformat"))
    book = jupytext.read(TUTORIAL)
    book.cells.append(nbformat.v4.new_code_cell(LOOK))
    where = {"metadata": {"path": str(tmp_path_factory.mktemp("tutorial"))}}
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("MPLBACKEND", raising=False)  # a command that ran in this process has set it
        nbclient.NotebookClient(book, kernel_name="python3", timeout=600, iopub_timeout=120, resources=where).execute()
    return book


def outputs(notebook, source):
    """Those of the one cell that holds a piece of source."""
    (cell,) = (cell for cell in notebook.cells if cell.cell_type == "code" and source in cell.source)
    return cell.outputs


def said(notebook, source):
    """What the cell printed."""
    return "".join(output.text for output in outputs(notebook, source) if output.output_type == "stream")


def shown(notebook, source):
    """Kinds of content that the value of the cell is shown by, last output first."""
    return [set(output.data) for output in reversed(outputs(notebook, source)) if "data" in output]


def test_the_numbers_of_the_tutorial_are_those_of_the_closed_forms(notebook):
    found, joint = json.loads(said(notebook, "json.dumps")), Joint()
    peak = float(joint.peak(COMPRESSION))
    assert found["peak"] == pytest.approx(peak, rel=1e-3)  # what an accuracy of 1 % leaves: 0.04 % measured
    for law in ("linear", "exponential"):
        assert found["peaks"][law] == pytest.approx(peak, rel=1e-3)
        assert found["residuals"][law] == pytest.approx(float(shear(law, joint, MOVED, COMPRESSION)), rel=1e-9)
    assert found["slope"] == pytest.approx(joint.tan0, rel=5e-3)
    assert found["cohesion"] == pytest.approx(joint.c0, rel=5e-3)
    assert found["imbalance"] < 1e-10


def test_more_steps_come_nearer_to_the_closed_form(notebook):
    found = re.findall(r"(\d+) steps of shear  error of the peak ([\d.]+) %", said(notebook, "6400"))
    errors = [float(error) for _, error in found]
    assert [int(steps) for steps, _ in found] == [100, 400, 1600, 6400]
    assert errors == sorted(errors, reverse=True) and errors[0] < 2.0 and errors[-1] < 0.02


def test_a_coarse_look_at_the_wall_lies_between_the_bounds_and_near_the_careful_one(notebook):
    coarse, careful = json.loads(said(notebook, "json.dumps"))["walls"]
    assert 0.114e6 < careful < 0.214e6, "the bounds that docs/trust.md gives"
    assert coarse == pytest.approx(careful, rel=0.05)


def test_no_cell_fails_and_what_does_not_fit_is_refused_with_what_is_allowed(notebook):
    assert [out for cell in notebook.cells for out in cell.get("outputs", ()) if out.output_type == "error"] == []
    assert "did you mean 'linear'?" in said(notebook, "liner")


def test_scenes_results_tables_and_figures_show_themselves_once(notebook):
    for source in ("scene\n", "masonry.check(scene)", "result = masonry.run(scene)\nresult", "curve[["):
        assert "text/html" in shown(notebook, source.strip("\n") if source != "scene\n" else '"couplet")\nscene')[0]
    for source in ("result.plot()", "axes.legend();", 'looks["1 %"].picture()'):
        pictures = [kinds for kinds in shown(notebook, source) if "image/png" in kinds]
        assert len(pictures) == 1


def test_a_run_leaves_no_line_of_progress_behind(notebook):
    texts = [output.data["text/plain"] for output in outputs(notebook, "result = masonry.run(scene)\nresult")]
    assert texts[0] == "" and len(texts) == 2 and texts[1].startswith("Result")
