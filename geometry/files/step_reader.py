"""Data in the text of a STEP file (ISO 10303-21) beside the shapes: records, strings, the unit of length.

The CAD kernel can hand over names itself, but takes time that grows as the square of the number of solids.
"""

import re
from collections.abc import Iterable

import numpy as np

from geometry.blocks import GeometryError

Records = dict[int, tuple[str, str]]
SI_PREFIX = {"": 1.0, "DECI": 0.1, "CENTI": 1e-2, "MILLI": 1e-3, "MICRO": 1e-6, "DECA": 10.0, "KILO": 1e3}
_STRING = r"'(?:[^']++|'')*+'"
_RECORD = re.compile(rf"#(\d{{1,18}})\s*=\s*([A-Z0-9_]*)\s*\(((?:[^';]++|{_STRING})*+);")
_COMMENT = re.compile(rf"{_STRING}|/\*.*?(?:\*/|\Z)", re.DOTALL)
_STRINGS = re.compile(_STRING)
_REFERENCE = re.compile(r"#(\d{1,18})")
_NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
_WIDE = re.compile(r"\\X2\\((?:[0-9A-F]{4})*)\\X0\\")


def records(text: str) -> Records:
    """Number -> type and arguments of every entity; the type of a complex entity is empty."""
    if "/*" in text:
        text = _COMMENT.sub(lambda match: match[0] if match[0][0] == "'" else " ", text)
    return {int(number): (kind, arguments) for number, kind, arguments in _RECORD.findall(text)}


def references(arguments: str) -> list[int]:
    """Numbers of the entities that the arguments refer to."""
    return [int(number) for number in _REFERENCE.findall(_STRINGS.sub("''", arguments))]


def strings(arguments: str) -> list[str]:
    """The strings among the arguments, decoded."""
    return [_decoded(match[1:-1]) for match in _STRINGS.findall(arguments)]


def numbers(arguments: str) -> list[float]:
    """The numbers among the arguments, without the references."""
    return [float(match) for match in _NUMBER.findall(_REFERENCE.sub("", _STRINGS.sub("", arguments)))]


def length_unit(entities: Records) -> float:
    """m, the unit that the file states for its lengths. Raises GeometryError if it states none or several."""
    units = [text for kind, text in entities.values() if kind == "" and "LENGTH_UNIT" in text]
    lengths = {_unit(entities, text) for text in units}
    lengths -= {_base(entities, text) for text in units}
    if len(lengths) != 1:
        said = ", ".join(f"{unit:g} m" for unit in sorted(lengths)) or "none"
        raise GeometryError(f"the file must state one unit of length; it states: {said}")
    return lengths.pop()


def _unit(entities: Records, text: str) -> float:
    """Metres of a unit such as (LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.)); NaN if it cannot be told."""
    if measure := _measure(entities, text):
        return (numbers(measure) or [float("nan")])[0] * _base(entities, text)
    prefix = re.search(r"SI_UNIT\s*\(\s*(?:\.(\w+)\.|\$)\s*,\s*\.METRE\.", text)
    return SI_PREFIX.get(prefix[1] or "", float("nan")) if prefix else float("nan")


def _base(entities: Records, text: str) -> float:
    """Metres of the unit that another one, such as the inch, is stated in; 0 for one that stands by itself."""
    base = [entities[r][1] for r in references(_measure(entities, text)) if r in entities]
    return _unit(entities, base[0]) if base and "CONVERSION_BASED_UNIT" not in base[0] else 0.0


def _measure(entities: Records, text: str) -> str:
    """Arguments of the LENGTH_MEASURE_WITH_UNIT of a converted unit; empty for a unit that is not."""
    if "CONVERSION_BASED_UNIT" not in text:
        return ""
    measures = (entities.get(r, ("", "")) for r in references(text))
    return next((arguments for kind, arguments in measures if kind.endswith("MEASURE_WITH_UNIT")), "")


def placement(entities: Records, number: int) -> np.ndarray:
    """(4, 4) from the axes of an AXIS2_PLACEMENT_3D to those it stands in, in the unit of the file."""
    vectors = [numbers(entities[r][1]) for r in references(entities.get(number, ("", ""))[1]) if r in entities]
    vector = [np.array(v[:3]) for v in vectors if len(v) >= 3]
    matrix = np.eye(4)
    if vector:
        matrix[:3, 3] = vector[0]
    z = vector[1] if len(vector) > 1 else np.array([0.0, 0.0, 1.0])
    x = vector[2] if len(vector) > 2 else np.array([1.0, 0.0, 0.0])
    y = np.cross(z, x)
    if np.linalg.norm(y) > 0:
        axes = np.stack([np.cross(y, z), y, z], axis=1)
        matrix[:3, :3] = axes / np.linalg.norm(axes, axis=0)
    return matrix


def _decoded(text: str) -> str:
    text = _WIDE.sub(lambda match: bytes.fromhex(match[1]).decode("utf-16-be", "replace"), text)
    text = re.sub(r"\\X\\([0-9A-F]{2})", lambda match: bytes.fromhex(match[1]).decode("latin-1"), text)
    return re.sub(r"\\S\\(.)", lambda match: chr((ord(match[1]) + 128) % 256), text).replace("''", "'")


Colour = tuple[float, ...]
PREDEFINED = {
    "red": (1, 0, 0),
    "green": (0, 1, 0),
    "blue": (0, 0, 1),
    "yellow": (1, 1, 0),
    "magenta": (1, 0, 1),
    "cyan": (0, 1, 1),
    "black": (0, 0, 0),
    "white": (1, 1, 1),
}


def colours(entities: Records, of_kind: dict[str, list[int]], solids: Iterable[int]) -> dict[int, Colour]:
    """The colours of those of the solids that have one, or else of the first of their faces that has.

    of_kind  numbers of the entities of each type
    """
    painted: dict[int, Colour] = {}
    for kind in ("STYLED_ITEM", "OVER_RIDING_STYLED_ITEM"):
        for number in of_kind.get(kind, []):
            *styles, item = [*references(entities[number][1])[:2], -1][:2]
            colour = _colour(entities, styles[0]) if styles else None
            if colour is not None:
                painted[item] = colour
    result = {}
    for solid in solids:
        below = [solid, *(n for shell in references(entities[solid][1]) for n in _below(entities, shell))]
        own_colour = next((painted[n] for n in below if n in painted), None)
        if own_colour is not None:
            result[solid] = own_colour
    return result


def _below(entities: Records, number: int) -> list[int]:
    return [number, *references(entities.get(number, ("", ""))[1])]


def _colour(entities: Records, style: int) -> Colour | None:
    waiting, seen = [style], {style}
    while waiting and len(seen) < 1000:
        kind, arguments = entities.get(waiting.pop(), ("", ""))
        if kind == "COLOUR_RGB":
            value = tuple(numbers(arguments)[:3])
            return value if len(value) == 3 else None
        if kind == "DRAUGHTING_PRE_DEFINED_COLOUR":
            return PREDEFINED.get(strings(arguments)[0] if strings(arguments) else "")
        below = [n for n in references(arguments) if n not in seen]
        seen.update(below)
        waiting += below
    return None
