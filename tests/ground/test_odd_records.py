"""Records that are odd, damaged or made to do harm are read in a time that grows with their size, or refused."""

import time

import pytest

from masonry.errors import SceneError
from masonry.ground.records.reading import read_record
from masonry.laboratory.summary.provenance import provenance_of
from masonry.scene import load, to_toml
from masonry.sweeps.job import Job
from tests.ground.test_ground_keys import BLOCK, scene

ELASTIC = {"young_modulus": "1 GPa", "poisson_ratio": 0.2}
SIZE = 100_000
"""Letters of a line."""
ROWS = "0.00,0.1\n0.01,-0.2\n0.02,0.3\n"


def record(folder, text):
    """The record of a file with this text."""
    file = folder / "own.csv"
    file.write_text(text, encoding="utf-8")
    return read_record(file)


def tried(folder, text):
    """Processor seconds until a file is read or refused."""
    began = time.process_time()
    try:
        own = record(folder, text)
        for column in range(len(own.columns)):
            own.unit_of(column)
        own.samples("acceleration", "acceleration", "g")
    except SceneError:
        pass
    return time.process_time() - began


@pytest.mark.parametrize(
    "text",
    [
        "{a (}\n0 1\n1 2\n2 3\n",
        "{a [}\n0 1\n1 2\n2 3\n",
        '{" (}\n0 1\n1 2\n2 3\n',
        "time,{(}\n" + ROWS,
        "time,{ }acceleration (g\n" + ROWS,
        "time,acceleration{ }(g){ }x\n" + ROWS,
        "time,acceleration {((})\n" + ROWS,
        "{1}\nNPTS = 3\n0.1 0.2\n",
        "x{1} y\n0.1 0.2\n",
        "NPTS = 3{ }x\n0.1 0.2\n0.3",
        "NPTS = 3{\n}x\n0.1 0.2\n0.3",
        "x 1{ }x\n0.1 0.2\n0.3",
        "x 1{ .}x\n0.1 0.2\n0.3",
        "UNITS OF {G}\nNPTS = 3\n0.1 0.2\n0.3",
    ],
)
def test_a_line_costs_no_more_than_ten_times_a_tenth_of_it(tmp_path, text):
    def made(size):
        before, _, rest = text.partition("{")
        unit, _, behind = rest.partition("}")
        return before + unit * (size // len(unit)) + behind

    tried(tmp_path, made(SIZE // 100))
    few = min(tried(tmp_path, made(SIZE // 10)) for _ in range(3))
    many = min(tried(tmp_path, made(SIZE)) for _ in range(2))
    assert many < 40 * max(few, 5e-4)  # where it costs its square: 100 times


def test_names_keep_their_units_in_brackets(tmp_path):
    own = record(tmp_path, "Time (s), East [cm/s2] ,Up (raw) (g)\n0.0,1,2\n0.1,1,3\n0.2,1,4\n")
    assert [own.unit_of(k) for k in range(3)] == ["s", "cm/s2", "g"]
    assert own.column("east") == 1 and own.column("up (raw)") == 2


@pytest.mark.parametrize("cell", ["1_0.0", '"0.1', "'0.1", "\u0661", "1" * 5000, "0." + "1" * 131_100 + "x", "inf"])
def test_what_is_no_plain_number_is_refused_with_its_row(tmp_path, cell):
    with pytest.raises(SceneError, match="row 2 of the numbers: .* is not a finite number") as said:
        record(tmp_path, f"time (s),acceleration (g)\n0.00,0.1\n0.01,{cell}\n0.02,0.3\n")
    assert len(str(said.value)) < 300


def test_a_cell_in_quotes_may_be_long_or_not_end(tmp_path):
    long = f'"{"x" * 140_000}"'
    assert record(tmp_path, f"time (s),{long}\n{ROWS}").values.shape == (3, 2)
    with pytest.raises(SceneError, match="row 2 of the numbers"):
        record(tmp_path, ROWS.replace("-0.2", long))


def test_a_number_of_a_column_with_thousands_of_digits_is_no_column(tmp_path):
    own = record(tmp_path, "time (s),acceleration (g)\n" + ROWS)
    with pytest.raises(SceneError, match="has no column '999"):
        own.column("9" * 5000)


@pytest.mark.parametrize(
    "head",
    ["NPTS = " + "9" * 5000 + ", DT = 0.01", "NPTS = 3, DT = 1.2.3", "3 . NPTS, DT", "NPTS = 3, DT = 1E999"],
)
def test_a_head_of_peer_with_odd_numbers_is_refused(tmp_path, head):
    with pytest.raises(SceneError, match="samples, and 3 numbers follow|is no number of a file of PEER"):
        record(tmp_path, f"PEER\n{head}\n0.1 0.2\n0.3\n")


@pytest.mark.parametrize(
    ("head", "step"), [("NPTS = 3, DT = 1E-300", None), ("NPTS = 3", 1e-12), ("NPTS = 3, DT = 999999.", None)]
)
def test_a_step_that_no_instrument_takes_is_refused(tmp_path, head, step):
    own = record(tmp_path, f"PEER\n{head}\n0.1 0.2\n0.3\n")
    with pytest.raises(SceneError, match="from sample to sample; allowed: 1e-09 to 100000 s"):
        own.time(None, step)
    with pytest.raises(SceneError, match="from sample to sample; allowed"):
        record(tmp_path, "0,0.1\n1e-300,0.2\n2e-300,0.3\n").time(None)


@pytest.mark.parametrize("formula", ["0.3 g / 0", "0.3 g * 1 s / t", "0.3 g / (t - 2 s) * 1 s", "0.3 g * 1e9 * 1e300"])
def test_a_formula_without_a_finite_value_is_refused_with_the_time(tmp_path, formula):
    with pytest.raises(SceneError, match=r"ground\.x: the expression has no finite value at t = [02] s|at most 1e\+06"):
        _ = scene(tmp_path, {"x": formula, "duration": "4 s"}).ground[0].motions


def test_a_record_that_no_ground_follows_is_refused(tmp_path):
    file = tmp_path / "own.csv"
    for value in ("1e308", "1e9"):
        file.write_text(f"time (s),a (g)\n0.0,0.1\n0.1,{value}\n0.2,0.1\n0.3,0\n")
        with pytest.raises(SceneError, match=r"ground: it accelerates by .* at most 1e\+06 are allowed"):
            _ = scene(tmp_path, {"record": str(file), "x": "a"}).ground[0].motions
    file.write_text("time (s),v (m/s)\n0.0,0.0\n0.1,1e308\n0.2,-1e308\n0.3,0\n")
    with pytest.raises(SceneError, match="ground"):
        _ = scene(tmp_path, {"record": str(file), "x": "v", "quantity": "velocity"}).ground[0].motions


def test_a_run_is_told_from_one_with_other_files_whichever_table_names_them(tmp_path):
    """The record of the ground, that of a wave which comes in, and the curve measured beside a run."""
    file, plain = tmp_path / "own.csv", {"x": "a", "record": str(tmp_path / "own.csv")}
    quiet = {"kinematics": "affine", "quiet": [{"on": "block.x-"}, {"on": "block.x+", "wave": plain}]}
    rigid = {f"material.{group}.{key}": value for group in ("units", "base") for key, value in ELASTIC.items()}
    drive = {"on": "block", "direction": "x", "displacement": "1 mm"}
    measured = {"measured": str(file), "measured_columns": ["1", "2"], "measured_units": ["mm", "kN"]}
    tables = [{"ground": plain}, quiet | rigid, {"drive": drive, "curve": measured}, {}]
    file.write_text("time (s),a (g)\n0.0,0.1\n0.1,0.2\n0.2,0.1\n0.3,0\n")
    (tmp_path / "block.toml").write_text(BLOCK)
    made = [load(tmp_path / "block.toml", one) for one in tables]
    before = [provenance_of(to_toml(one)) for one in made]
    keys = [Job(one).key() for one in made]
    assert [one for one in before if "its records" in one] == before[:3]
    file.write_text("time (s),a (g)\n0.0,0.1\n0.1,0.2\n0.2,0.3\n0.3,0\n")
    for one, was, key in zip(made[:3], before, keys, strict=False):
        now = provenance_of(to_toml(one))
        assert {name for name in now if now[name] != was[name]} == {"its records"}
        assert Job(one).key() != key
    assert provenance_of(to_toml(made[3])) == before[3]
