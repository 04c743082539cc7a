"""The keys that vary in a sweep, and the values that they take, in words and units for pictures."""

from collections.abc import Sequence
from typing import NamedTuple

from masonry.judgement.words import readable, scale_of
from masonry.sweeps.job import short_text
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.sweep_table import swept


class VariedKey(NamedTuple):
    """A key that varies, its unit, and its values by run: as numbers (SI), where they are some, and as texts."""

    key: str
    unit: str
    numbers: list[float] | None
    texts: list[str]

    @property
    def words(self) -> str:
        """The name of the key."""
        return key_words(self.key)

    def scaled(self) -> tuple[list[float], str]:
        """The numbers in a unit that people read, and their name with this unit."""
        numbers = self.numbers or []
        factor, unit = scale_of(max(map(abs, numbers), default=0.0), self.unit)
        return [number / factor for number in numbers], f"{self.words} [{unit}]" if unit else self.words

    @property
    def distinct(self) -> list[str]:
        """The values as they were given, numbers from the least to the largest."""
        numbers = self.numbers or list(range(len(self.texts)))
        return list(dict.fromkeys(text for _, text in sorted(zip(numbers, self.texts, strict=True))))


GROUPED = ("contact", "material")
"""Tables of which a key is known by its group."""


def key_words(key: str) -> str:
    """A dotted key for people: what it is, and in brackets whose: `tensile strength (unit_unit)`."""
    *tables, last = key.split(".")
    whose = ".".join(tables[1:] if len(tables) > 1 and tables[0] in GROUPED else tables)
    return f"{last.replace('_', ' ')} ({whose})" if whose else last.replace("_", " ")


def value_text(value: object) -> str:
    """A value as it was given, with four digits and a prefix to its unit: no place for more."""
    return readable(value, 4) if isinstance(value, str) else short_text(value)


def keys_that_vary(planned: Sequence[Planned]) -> list[VariedKey]:
    """The keys that vary; of those that change together the first."""
    rows = swept(planned)
    axes: list[VariedKey] = []
    for key in dict.fromkeys(key for run in planned for key in run.values):
        column = next((name for row in rows for name in row if name.startswith(f"{key} [")), key)
        values, texts = [row.get(column) for row in rows], [value_text(row.get(key)) for row in rows]
        numbers = [float(value) for value in values if isinstance(value, int | float) and not isinstance(value, bool)]
        unit = column.removeprefix(key).strip(" []")
        axis = VariedKey(key, unit, numbers if len(numbers) == len(values) else None, texts)
        if len(set(texts)) > 1 and not any(_together(axis, other) for other in axes):
            axes.append(axis)
    return axes


def _together(one: VariedKey, other: VariedKey) -> bool:
    """Whether each value of one goes with one value of the other; of numbers, as they grow: samples of two keys differ
    all of them, and are independent."""
    pairs = set(zip(one.texts, other.texts, strict=True))
    if not len(pairs) == len(set(one.texts)) == len(set(other.texts)):
        return False
    if one.numbers is None or other.numbers is None:
        return True
    along = [number for _, number in sorted(zip(one.numbers, other.numbers, strict=True))]
    return along in (sorted(along), sorted(along, reverse=True))
