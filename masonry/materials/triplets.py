"""Shear tests of triplets by EN 1052-3: the line through their strengths, and how well the tests know it."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from masonry.errors import SceneError, visible

MPA = 1e6
LARGEST = 1_000_000
"""Bytes of a file of tests."""
HIGHEST = 50.0
"""MPa: no joint is tested beyond."""
SURE = 0.10
"""Share of a value that three series of tests leave open at least."""


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
    square = sum((strength - cohesion - tan * pressure) ** 2 for pressure, strength in tests) / (count - 2)
    return ShearLine(
        cohesion,
        tan,
        max(2.0 * math.sqrt(square * (1.0 / count + x0**2 / sxx)), SURE * cohesion),
        max(2.0 * math.sqrt(square / sxx), SURE * tan),
        count,
        len(pressures),
    )


def read_triplets(value: Any, where: str) -> tuple[tuple[float, float], ...]:
    """(pressure, shear strength) of each test in Pa: from a CSV file in MPa, or from pairs of texts ("0.2 MPa") or Pa.

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
    return tuple(_in_range(pressure, strength, where) for pressure, strength in tests)


def _is_amount(one: Any) -> bool:
    return isinstance(one, str) or (hasattr(one, "__float__") and not isinstance(one, bool))


def _of_file(path: Path, where: str) -> tuple[tuple[float, float], ...]:
    """Two columns in MPa, between them a comma, or a semicolon and decimal commas; a first line may be a heading."""
    from masonry.runtime.text_files import text_of

    tests: list[tuple[float, float]] = []
    for number, line in enumerate(text_of(path, LARGEST).splitlines(), 1):
        line = line.split("#")[0]
        line = line.replace(",", ".").replace(";", " ") if ";" in line else line.replace(",", " ")
        words = line.split()
        if not words:
            continue
        try:
            pressure, strength = map(float, words)
        except ValueError:
            if not tests and not any(word[0].isdigit() for word in words):
                continue
            raise SceneError(
                f"{path}, line {number}: '{visible(line[:60])}' is no pressure and shear strength in MPa, "
                "such as '0.2, 0.41'"
            ) from None
        tests.append(_in_range(pressure, strength, f"{path}, line {number}"))
    if not tests:
        raise SceneError(f"{path}: no tests; a line for each, pressure and shear strength in MPa: '0.2, 0.41'")
    return tuple(tests)


def _in_range(pressure: float, strength: float, where: str) -> tuple[float, float]:
    """In Pa, where both are such as a test has them."""
    if not (0.0 <= pressure <= HIGHEST and 0.0 < strength <= HIGHEST):
        pair, most = f"{pressure:g} and {strength:g} MPa", f"{HIGHEST:g} MPa"
        raise SceneError(f"{where}: {pair} look wrong; pressures are 0 to {most}, shear strengths above 0 to {most}")
    return pressure * MPA, strength * MPA
