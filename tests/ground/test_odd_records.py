"""Records that are odd, damaged or made to do harm are read in a time that grows with their size, or refused."""

import time

import pytest

from masonry.errors import SceneError
from masonry.ground.records.reading import read_record

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
