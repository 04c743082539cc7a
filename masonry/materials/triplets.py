"""Shear tests of triplets by EN 1052-3: the line through their strengths, and how well the tests know it."""

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from masonry.errors import SceneError, did_you_mean, visible

MPA = 1e6
LARGEST = 1_000_000
"""Bytes of a file of tests."""
HIGHEST = 50.0
"""MPa: no joint is tested beyond."""
STRONGEST = 8.0
"""MPa: no joint has a cohesion beyond."""
SPECIMENS = 9
"""Tests that EN 1052-3 asks for, three at each of three pressures."""
WEAKEST = 1e3
"""Pa: a joint under pressure bears more."""
SURE = 0.10
"""Share of a value that three series of tests leave open at least."""
HEADING = "pressure [kPa]; shear strength [kPa]"
BRACKET = re.compile(r"[\[(]")
KNOWN_UNITS = ("Pa", "kPa", "MPa", "N/mm2", "N/cm2", "kN/m2", "kgf/cm2", "psi")
BARE_UNIT = re.compile(r"(?<![A-Za-z])(?:[kMG]?Pa|psi|[kM]?N/[cm]?m\^?[2²])(?![A-Za-z0-9])")


class TripletTests(NamedTuple):
    """(pressure, shear strength) of each test in Pa, and what to mind of the file that they are from."""

    pairs: tuple[tuple[float, float], ...]
    notes: tuple[str, ...] = ()


class ShearLine(NamedTuple):
    """tau = cohesion + pressure tan, in Pa, and two standard errors of both; tests and pressures that it is from."""

    cohesion: float
    tan: float
    cohesion_error: float
    tan_error: float
    tests: int
    pressures: int


def shear_line(tests: Sequence[tuple[float, float]], where: str) -> ShearLine:
    """The straight line by least squares through pressures and shear strengths (Pa). Raises SceneError."""
    count = len(tests)
    pressures = {round(pressure) for pressure, _ in tests}
    if count < 3 or len(pressures) < 2:
        raise SceneError(
            f"{where}: {count} tests at {len(pressures)} pressures; EN 1052-3 asks for three tests at each of three "
            "pressures, a line needs three tests at two of them at least"
        )
    if (most := max(strength for _, strength in tests)) < WEAKEST:
        raise SceneError(
            f"{where}: shear strengths of at most {most:.3g} Pa look wrong; numbers are in Pa: write '0.41 MPa'"
        )
    x0 = sum(pressure for pressure, _ in tests) / count
    y0 = sum(strength for _, strength in tests) / count
    sxx = sum((pressure - x0) ** 2 for pressure, _ in tests)
    tan = sum((pressure - x0) * (strength - y0) for pressure, strength in tests) / sxx
    cohesion = y0 - tan * x0
    if tan <= 0.0 or cohesion < 0.0:
        raise SceneError(
            f"{where}: the line through these tests is {cohesion / MPA:.3g} MPa + {tan:.3g} p, and neither may be "
            "negative; are the columns pressure and shear strength, in this order?"
        )
    if cohesion > STRONGEST * MPA:
        raise SceneError(
            f"{where}: the line through these tests has a cohesion of {cohesion / MPA:.3g} MPa, which looks wrong; it "
            f"is usually below {STRONGEST:g} MPa. A file names the unit of each column in its heading: '{HEADING}'"
        )
    square = sum((strength - cohesion - tan * pressure) ** 2 for pressure, strength in tests) / (count - 2)
    return ShearLine(
        cohesion,
        tan,
        max(2.0 * math.sqrt(square * (1.0 / count + x0**2 / sxx)), SURE * cohesion),
        max(2.0 * math.sqrt(square / sxx), SURE * tan),
        count,
        len(pressures),
    )


def read_triplets(value: Any, where: str) -> TripletTests:
    """Tests from a CSV file, in MPa or in the units of its heading, or from pairs of texts ("0.2 MPa") or Pa.

    Raises SceneError.
    """
    from masonry.quantity import parse

    if isinstance(value, str | Path):
        return _of_file(Path(value), where)
    try:
        pairs = [tuple(pair) for pair in value]
    except TypeError:
        pairs = [()]
    if any(len(pair) != 2 for pair in pairs) or not pairs:
        raise SceneError(f"{where}: give pairs of pressure and shear strength, or the path of a CSV file of them")
    tests = []
    for pair in pairs:
        texts = [one if isinstance(one, str) else f"{float(one):.17g} Pa" for one in pair if _is_amount(one)]
        if len(texts) != 2:
            raise SceneError(
                f"{where}: {visible(f'{pair!r:.60}')} is no pair of stresses such as ('0.2 MPa', '0.41 MPa')"
            )
        tests.append(tuple(parse(text, "stress", where) / MPA for text in texts))
    return TripletTests(tuple(_in_range(pressure, strength, where) for pressure, strength in tests))


def _is_amount(one: Any) -> bool:
    return isinstance(one, str) or (hasattr(one, "__float__") and not isinstance(one, bool))


def _of_file(path: Path, where: str) -> TripletTests:
    """Two columns, between them a comma, or a semicolon and decimal commas; lines of a heading may name their units."""
    from masonry.runtime.text_files import text_of

    tests: list[tuple[float, float]] = []
    units: tuple[float, float] | None = None
    for number, line in enumerate(text_of(path, LARGEST).splitlines(), 1):
        line = line.split("#")[0]
        place = f"{path}, line {number}"
        words = _words(line)
        if not words:
            continue
        columns = _numbers(words)
        if columns is None and not tests and _is_heading(line, words):
            units = _units(line, place) or units
            continue
        shown = visible(line.strip()[:60])
        if len(words) != 2:
            raise SceneError(
                f"{place}: {len(words)} columns in place of two in '{shown}'; give pressure and shear strength "
                "alone, without numbers of specimens; decimal commas need a semicolon between columns: '0,2; 0,41'"
            )
        if columns is None:
            raise SceneError(f"{place}: '{shown}' is no pressure and shear strength such as '0.2, 0.41'")
        pressure, strength = (column * size for column, size in zip(columns, units or (1.0, 1.0), strict=True))
        hint = "" if units else f"; a heading such as '{HEADING}' names other units"
        tests.append(_in_range(pressure, strength, place, hint))
    if not tests:
        raise SceneError(f"{path}: no tests; a line for each, pressure and shear strength in MPa: '0.2, 0.41'")
    note = f"{where}: the file names no units, and MPa are taken; a heading such as '{HEADING}' names them"
    return TripletTests(tuple(tests), () if units else (note,))


def _words(line: str) -> list[str]:
    """Of a line with commas, spaces, or semicolons and decimal commas."""
    return (line.replace(",", ".").replace(";", " ") if ";" in line else line.replace(",", " ")).split()


def _is_heading(line: str, words: list[str]) -> bool:
    """Whether a line that is not all numbers has none, or begins with a word and names units beside them."""
    return not any(word[0].isdigit() for word in words) or (not words[0][0].isdigit() and bool(BRACKET.search(line)))


def _numbers(words: list[str]) -> list[float] | None:
    from masonry.quantity import is_plain

    try:
        return [float(word) for word in words] if all(map(is_plain, words)) else None
    except ValueError:
        return None


def _units(heading: str, place: str) -> tuple[float, float] | None:
    """Those of both columns in MPa, from brackets, parentheses, or names as they are; None where there is none."""
    from masonry.quantity import convert

    names = re.findall(r"\[([^\]]*)\]", heading) or re.findall(r"\(([^)]*)\)", heading) or BARE_UNIT.findall(heading)
    sizes = []
    for name in map(str.strip, names):
        try:
            sizes.append(convert(f"1 {name}", "stress", "unit") / MPA)
        except ValueError:
            alike = next((unit for unit in KNOWN_UNITS if unit.lower() == name.lower()), name[:20])
            hint = did_you_mean(alike, KNOWN_UNITS, 0.5)
            shown = visible(f"{name!r:.40}")
            raise SceneError(f"{place}: {shown} is no unit of a stress, such as kPa, MPa or N/mm2{hint}") from None
    if len(sizes) not in (0, 2):
        raise SceneError(f"{place}: {len(sizes)} units for two columns; give each its own: '{HEADING}'")
    return (sizes[0], sizes[1]) if sizes else None


def _in_range(pressure: float, strength: float, where: str, hint: str = "") -> tuple[float, float]:
    """In Pa, where both are such as a test has them."""
    if not (0.0 <= pressure <= HIGHEST and 0.0 < strength <= HIGHEST):
        pair, most = f"{pressure:g} and {strength:g} MPa", f"{HIGHEST:g} MPa"
        raise SceneError(
            f"{where}: {pair} look wrong; pressures are 0 to {most}, shear strengths above 0 to {most}{hint}"
        )
    return pressure * MPA, strength * MPA
