"""Colours of the solids of a STEP file: along the styles of what is drawn."""

from collections.abc import Iterable

from geometry.files.step_reader import Records, numbers, references, strings

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
        own = next((painted[n] for n in below if n in painted), None)
        if own is not None:
            result[solid] = own
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
