"""Quantities: exact units, and a refusal that helps."""

import subprocess
import sys
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from masonry.errors import SceneError
from masonry.quantity import KINDS, parse


@pytest.mark.parametrize(
    ("one", "other", "kind"),
    [
        ("1 N/mm^2", "1 MPa", "stress"),
        ("1 N/mm2", "1 MPa", "stress"),
        ("1 N/mm²", "1 MPa", "stress"),
        ("1 N mm^-2", "1 MPa", "stress"),
        ("0.87 MPa", "870 kPa", "stress"),
        ("150 GPa/m", "150 N/mm^2/mm", "stiffness"),
        ("0.058 N/mm", "58 N/m", "energy"),
        ("58 J/m^2", "58 N/m", "energy"),
        ("130 N/m/MPa", "0.13 N/mm/MPa", "energy per stress"),
        ("1.9 g/cm^3", "1900 kg/m^3", "density"),
        ("1 in", "25.4 mm", "length"),
        ("180 deg", "3.141592653589793 rad", "angle"),
        ("1000 µm", "0.1 cm", "length"),
        ("0.1 mm/s", "360 mm/h", "velocity"),
    ],
)
def test_equal_quantities_in_different_units_give_the_same_bits(one, other, kind):
    assert parse(one, kind, "here") == parse(other, kind, "here")


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [("0.87 MPa", "stress", 0.87e6), ("150GPa/m", "stiffness", 150e9), ("130 N/m/MPa", "energy per stress", 130e-6)],
)
def test_a_quantity_is_the_nearest_float_to_its_si_value(text, kind, value):
    assert parse(text, kind, "here") == value


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from([k for k in KINDS if KINDS[k].unit]))
def test_an_si_value_written_out_is_read_back_bit_by_bit(value, kind):
    assert parse(f"{value!r} {KINDS[kind].unit}", kind, "here") == value


@pytest.mark.parametrize("kind", KINDS)
def test_the_example_of_every_kind_is_of_that_kind(kind):
    assert isinstance(parse(KINDS[kind].example, kind, "here"), float | int)


@pytest.mark.parametrize(
    ("text", "kind", "words"),
    [
        ("150 MPa", "stiffness", ["MPa is a stress", "a stress per length", "'150 GPa/m'"]),
        ("5 m", "stress", ["m is a length", "'0.5 MPa'"]),
        ("5 kg", "length", ["kg does not fit", "'200 mm'"]),
        ("150e9", "stiffness", ["no unit", "'150 GPa/m'"]),
        (150e9, "stiffness", ["no unit", "'150 GPa/m'"]),
        ("0.5 Mpa", "stress", ["no known unit", "did you mean 'MPa'"]),
        ("0.5 mPa", "stress", ["did you mean MPa"]),
        ("0,5 MPa", "stress", ["decimal point"]),
        ("5 degC", "length", ["no place in a scene"]),
        ("5 dBm", "stress", ["no place in a scene"]),
        ("nan MPa", "stress", ["not a number and a unit"]),
        ("1e999 MPa", "stress", ["not a finite number"]),
        (float("inf"), "number", ["not a finite number"]),
        (10**400, "number", ["not a plain number"]),
        ("0.2 m", "number", ["not a plain number"]),
        (True, "number", ["not a quantity"]),
        (2.5, "integer", ["not a whole number"]),
        ([1], "length", ["not a quantity"]),
        ("5 m^77", "length", ["not a number and a unit"]),
        ("(2) m", "length", ["not a number and a unit"]),
        ("5 __import__", "length", ["not a number and a unit"]),
    ],
)
def test_a_wrong_quantity_is_told_with_its_place_and_what_would_do(text, kind, words):
    with pytest.raises(SceneError) as error:
        parse(text, kind, "a.toml, line 3: contact.c.key")
    message = str(error.value)
    assert message.startswith("a.toml, line 3: contact.c.key: ")
    assert "\n" not in message
    for word in words:
        assert word in message


@pytest.mark.parametrize(
    ("text", "kind", "allowed", "words"),
    [
        ("-5 MPa", "stress", "[0, inf)", "0 or more"),
        ("0 m", "length", "(0, inf)", "more than 0"),
        (0.5, "number", "[0, 0.5)", "in [0, 0.5)"),
        ("90 deg", "angle", "[0, 90) deg", "in [0, 90) deg"),
        (1001, "integer", "[1, 1000]", "in [1, 1000]"),
    ],
)
def test_a_value_out_of_range_is_told_the_range(text, kind, allowed, words):
    with pytest.raises(SceneError, match="out of range") as error:
        parse(text, kind, "here", allowed)
    assert words in str(error.value)


@pytest.mark.parametrize(
    "text",
    ["9**9**9 m", "1" * 1_000_000 + " m", "1 " + "m" * 1_000_000, "1 m" + " " * 70 + "x", "1e-999 m" * 9, "9" * 70],
)
def test_no_text_can_hang_the_reader(text):
    started = time.perf_counter()
    with pytest.raises(SceneError) as error:
        parse(text, "length", "here")
    assert time.perf_counter() - started < 2.0
    assert len(str(error.value)) < 400


@given(st.text(max_size=100))
def test_any_text_is_either_a_number_or_one_clear_error(text):
    try:
        assert isinstance(parse(text, "length", "here"), float)
    except SceneError as error:
        assert str(error).startswith("here: ")


def test_importing_the_package_and_the_module_does_not_import_pint():
    code = "import sys, masonry, masonry.quantity; print('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"
