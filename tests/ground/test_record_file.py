"""Records are read from CSV files, and what is wrong with one is said in a sentence."""

import numpy as np
import pytest

from masonry.errors import SceneError
from masonry.ground.records.reading import read_record

GOOD = "time (s),acceleration (g)\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n"


def samples(folder, text, word="acceleration", quantity="acceleration", unit=None, time=None, step=None):
    """Times and values of a column of a file with this text."""
    file = folder / "own.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    record = read_record(file)
    return record.time(time, step), record.samples(word, quantity, unit)


@pytest.mark.parametrize(
    "text",
    [
        GOOD,
        b"\xef\xbb\xbf" + GOOD.encode(),
        GOOD.replace("\n", "\r\n"),
        "# Time Series: a town\n# Time (s),Acceleration (g's)\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n",
        "time,acceleration [cm/s2]\n2.00,98.0665\n2.01,-196.133\n2.02,294.1995\n\n",
        GOOD.replace(",", ";"),
        GOOD.replace(",", ";").replace(".", ",").replace("\n", "\r\n"),
        GOOD.replace(",", "\t"),
        "A town, 1995\ntime (s)  acceleration (g)\n 0.00  0.1\n 0.01 -0.2\n 0.02  0.3\n",
        "time,acceleration\ns,g\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n",
        '"time (s)","acceleration (g)"\n"0,00","0,1"\n"0,01","-0,2"\n"0,02","0,3"\n',
        '"time (s)" "acceleration (g)"\n"0.00" "0.1"\n"0.01" "-0.2"\n"0.02" "0.3"\n',
        "time (s);acceleration (g);;\n0,00;0,1;;\n0,01;-0,2;;\n0,02;0,3;;\n;;;\n",
        "time (s),acceleration (g)\n0.00,0.1,\n0.01,-0.2,\n0.02,0.3,\n",
        "acceleration (m/s/s), time\n0.980665,0.0\n-1.96133,0.01\n2.941995,0.02\n",
    ],
)
def test_a_record_comes_in_seconds_and_si_whatever_its_header_looks_like(tmp_path, text):
    named = {"time": "time"} if b"time" not in (text if isinstance(text, bytes) else text.encode())[:9] else {}
    time, values = samples(tmp_path, text, **named)
    assert time == pytest.approx([0.0, 0.01, 0.02]) and values == pytest.approx(9.80665 * np.array([0.1, -0.2, 0.3]))


def test_times_that_are_rounded_to_their_digits_are_equal_steps(tmp_path):
    time, _ = samples(tmp_path, "time,acceleration (g)\n0.00,1\n0.33,2\n0.67,3\n1.00,1\n")
    assert time == pytest.approx(np.arange(4) / 3)


def test_a_column_may_be_named_by_its_number(tmp_path):
    assert samples(tmp_path, "0,1\n1,2\n2,3\n", word="2", unit="m/s2")[1] == pytest.approx([1, 2, 3])


def test_values_without_times_follow_one_another_in_a_step(tmp_path):
    time, values = samples(tmp_path, "East (gal) at 100 Hz\n98.0665\n-196.133\n294.1995\n", "1", unit="gal", step=0.01)
    assert time == pytest.approx([0.0, 0.01, 0.02]) and values == pytest.approx(9.80665 * np.array([0.1, -0.2, 0.3]))


def test_a_file_of_peer_goes_on_from_line_to_line_and_says_its_step(tmp_path):
    heads = "PEER NGA\nA town, 1/16/1995, 090\nACCELERATION TIME SERIES IN UNITS OF G\n"
    numbers = "  .1000000E+00 -.2000000E+00\n  .3000000E+00\n"
    for line in ("NPTS=   3, DT=   .0100 SEC,\n", "   3   0.0100   NPTS, DT\n"):
        time, values = samples(tmp_path, heads + line + numbers, "1")
        assert time == pytest.approx([0.0, 0.01, 0.02]) and values == pytest.approx(
            9.80665 * np.array([0.1, -0.2, 0.3])
        )
    with pytest.raises(SceneError, match="says that its step is 0.01 s"):
        samples(tmp_path, heads + line + numbers, "1", step=0.02)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (GOOD.replace("-0.2", "nan"), "row 2 of the numbers: 'nan' is not a finite number"),
        (GOOD.replace("-0.2", ""), "row 2 of the numbers: '' is not a finite number"),
        (GOOD.replace("-0.2", "-0.2,7"), "row 2 of the numbers: 3 columns, where the first has 2"),
        (GOOD.replace("0.02", "0.03"), "a step of 0.0[12] s, where the others are 0.0"),
        (GOOD.replace("0.02", "0.01"), "row 3 of the numbers: the time 0.01 s is not later than the one before"),
        (GOOD.rsplit("\n", 2)[0] + "\n", "has 2 samples; a record has 3 or more"),
        ("time (s);acceleration (g)\n0,00;****\n0,01;-0,2\n0,02;0,3\n", "row 1 of the numbers: '\\*+' is not a finite"),
        ("time (s) acceleration (g)\n0,00 n.a.\n0,01 -0,2\n0,02 0,3\n", "row 1 of the numbers: 'n.a.' is not a finite"),
        ("time (s),acceleration (g)\n****,0.1\n0.01,1\n0.02,2\n0.03,1\n", "row 1 of the numbers: '\\*+' is not a"),
        ("acceleration (g)\n0,1\n-0,2\n0,3\n", "'0,1' may be one number with a decimal comma"),
        ("time;a\n0,00;1.234,5\n0,01;1\n0,02;2\n", "row 1 of the numbers: '1.234,5' has a point and a comma: write"),
        ("time;a\n0,00;1.234\n0,01;1\n0,02;2\n", "'1.234' with a point and '0,00' with a comma: write nothing"),
        ("NPTS= 4\n1.0 2.0\n3.0 4.0\n", "no column of times: say the time from sample to sample"),
        ("1,234\n-0,456\n0,789\n", "'1,234' may be one number with a decimal comma"),
        ("0,0\n12,5\n-3,25\n-0,5\n", "'0,0' may be one number with a decimal comma"),
        ("0,00,0,0\n0,01,12,5\n0,02,-3,25\n", "'0,00,0,0' may be numbers with a decimal comma"),
        ("time,acceleration\n0,00,0,0\n0,01,12,5\n0,02,-3,25\n", "may be numbers with a decimal comma"),
        ("acceleration (g)\n1\n2\n3\n", "has no column of times: say the time from sample to sample, step = '0.01 s'"),
        ("acceleration,up\n3,1\n2,2\n1,1\n", "not later than .*; if none has times, say the time from"),
        ("NPTS= 4, DT= .01 SEC\n1.0 2.0\n3.0 x\n", "'x' is no number of a file of PEER"),
        ("NPTS= 4, DT= .01 SEC\n1.0 2.0\n3.0\n", "says that it has 4 samples, and 3 numbers follow"),
        ("5 .01 NPTS, DT\n**** 2.0\n3.0 4.0\n5.0\n", "says that it has 5 samples, and 3 numbers follow"),
        ("time,acc (g)\n0,1\n1,2\n2,3\n", "no column 'acceleration'; known here: acc, time; did you mean 'acc'"),
        (
            "time (ms),acceleration (g)\n0,1\n1,2\n2,3\n",
            "the time is in 'ms', and must be in s; if none has times",
        ),
        (
            "time,acceleration (mm)\n0,1\n1,2\n2,3\n",
            "'mm' is the unit of a displacement, .* is quantity = 'displacement' meant",
        ),
        ("time,acceleration (counts)\n0,1\n1,2\n2,3\n", "'counts' is no unit of an acceleration; give g, m/s\\^2"),
        ("time,acceleration\n0,1\n1,2\n2,3\n", "unit: missing"),
        ("time,acceleration (g)\n0,1,5\n1,2,6\n2,3,7\n", "names 2 columns, the numbers have 3"),
        ("time,acceleration (g)\n", "has no line of numbers"),
        ("", "is empty"),
        (b"time,acceleration (\xff)\n", "not UTF-8"),
        ("a,a (g)\n0,1\n1,2\n2,3\n", "has no column 'acceleration'"),
    ],
)
def test_what_is_wrong_with_a_record_is_said_in_a_sentence(tmp_path, text, says):
    with pytest.raises(SceneError, match=says) as error:
        samples(tmp_path, text)
    assert len(error.value.lines) == 1


def test_a_unit_that_contradicts_the_file_is_refused(tmp_path):
    with pytest.raises(SceneError, match="unit = 'm/s2', but 'own.csv' says that 'acceleration' is in 'g'"):
        samples(tmp_path, GOOD, unit="m/s2")
    assert samples(tmp_path, GOOD, unit="g")[1][0] == pytest.approx(0.980665)
