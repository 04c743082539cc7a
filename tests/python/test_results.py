"""A result in Python: its curve as a table, its peak and energies, its figures, and how it shows itself."""

import json
import subprocess
import sys

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from tests.results.sample import sample

PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture
def no_pandas(monkeypatch):
    """As if pandas were not installed."""

    class Block:
        def find_spec(self, name, path=None, target=None):
            if name.partition(".")[0] == "pandas":
                raise ModuleNotFoundError(f"No module named '{name}'", name=name)

    for name in [name for name in sys.modules if name.partition(".")[0] == "pandas"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(sys, "meta_path", [Block(), *sys.meta_path])


def test_the_curve_is_a_table_of_pandas_with_the_rows_and_their_units():
    pandas = pytest.importorskip("pandas")
    result = sample()
    curve = result.curve
    assert isinstance(curve, pandas.DataFrame)
    assert list(curve.columns[:2]) == ["displacement", "stress"] and set(curve.columns) == set(result.history.rows)
    for name, values in result.history.rows.items():
        np.testing.assert_array_equal(curve[name], values)
    units = curve.attrs["units"]
    assert (units["stress"], units["displacement"], units["friction"]) == ("Pa", "m", "J")
    curve["stress"] += 1.0
    assert result.curve["stress"].iloc[0] == result.history.rows["stress"][0]


def test_without_pandas_the_curve_says_where_its_columns_are(no_pandas):
    with pytest.raises(SceneError, match="needs pandas.*result.history.rows has the same columns"):
        sample().curve  # noqa: B018


def test_peak_and_energies_are_those_of_the_summary():
    result = sample()
    result.summary |= {"peak_stress_pa": 190001.0, "displacement_at_peak_m": 4e-5, "energy_j": {"friction": 2.5}}
    assert result.peak.stress == 190001.0 and result.peak.displacement == 4e-5
    assert result.energies == {"friction": 2.5}
    assert result.trust == masonry.laboratory.text.trust(result.summary)


@pytest.mark.parametrize("draw", ["plot", "picture"])
def test_a_figure_is_given_back_and_shows_itself_once(draw, tmp_path):
    from matplotlib.figure import Figure

    figure = getattr(sample(), draw)()
    assert isinstance(figure, Figure) and figure.axes
    assert figure._repr_png_().startswith(PNG)
    assert "matplotlib.pyplot" not in sys.modules or not _managed()
    written = getattr(sample(), draw)(tmp_path / "a.png")
    assert isinstance(written, Figure) and (tmp_path / "a.png").read_bytes().startswith(PNG)


def _managed():
    """Figures that pyplot would show a second time."""
    import matplotlib.pyplot as plt

    return plt.get_fignums()


def test_a_result_shows_itself_on_less_than_a_screen_and_nothing_of_it_is_taken_for_html():
    result = sample()
    result.scene_toml = 'title = "<b>wall</b>"'
    result.summary |= {"gauges": {"<i>": {"at_peak_m": 1e-3, "final_m": 2e-3}}}
    text = repr(result)
    assert "wall" in text and "trust" in text and len(text.splitlines()) <= 24
    html = result._repr_html_()
    assert "<b>" not in html and "<i>" not in html and "&lt;i&gt;" in html and "peak stress" in html


def test_a_result_is_read_back_from_its_folder(tmp_path):
    result = sample()
    result.save_numbers(tmp_path)
    assert masonry.load_result(tmp_path).summary == json.loads((tmp_path / "summary.json").read_text())
    with pytest.raises(masonry.errors.SceneError, match="not a folder of results"):
        masonry.load_result(tmp_path / "none")


def test_importing_masonry_loads_nothing_heavy():
    code = "import masonry, sys; print([n for n in ('numpy', 'numba', 'pydantic', 'matplotlib') if n in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
