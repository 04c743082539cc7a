"""Units that fill a wall: the nearest size of which whole courses and half units make it."""

from typing import NamedTuple

from masonry.starting.options import Entries, metres


class Units(NamedTuple):
    """Length and height of a unit (m), without its joint, and how many courses."""

    length: float
    height: float
    courses: int

    @property
    def words(self) -> str:
        """A comment on their size."""
        return f"fitted: {self.length * 1e3:.4g} x {self.height * 1e3:.4g} mm"


def units_of(entries: Entries, joint: float) -> Units:
    """Units of a wall of `length` by `height` nearest to `unit_length` by `unit_height`. Raises SceneError."""
    wall_length, wall_height = entries.si("length"), entries.si("height")
    module, rise = entries.si("unit_length") + joint, entries.si("unit_height") + joint
    if module > wall_length * 1.5:
        raise entries.refusal(
            "unit_length", f"{entries.text('unit_length')}; the wall is {wall_length:g} m long: give a shorter one"
        )
    if rise > wall_height * 1.5:
        raise entries.refusal(
            "unit_height", f"{entries.text('unit_height')}; the wall is {wall_height:g} m high: give a lower one"
        )
    halves, courses = max(2, round(2.0 * wall_length / module)), max(1, round(wall_height / rise))
    if halves * courses > 2 * MOST_UNITS:
        raise entries.refusal(
            "unit_length",
            f"about {halves * courses // 2} units; a first scene has up to {MOST_UNITS}: take larger ones",
        )
    return Units(2.0 * wall_length / halves - joint, wall_height / courses - joint, courses)


MOST_UNITS = 2000
"""Of a first scene: more run for hours."""


class Facade(NamedTuple):
    """Half a module, length of the returns from the front, and place and size of the door; m."""

    half: float
    returns: float
    door: tuple[float, float] | None

    @property
    def unit_length(self) -> str:
        """As text of a scene."""
        return metres(2.0 * self.half)


def facade_of(entries: Entries) -> Facade:
    """Half modules between the corners that returns take, each about as long as that is thick, and a door of whole
    ones in its middle. Raises SceneError."""
    length, thick = entries.si("length"), entries.si("thickness")
    deep = entries.si("returns")
    corner = thick if deep else 0.0
    between = length - 2.0 * corner
    if between < thick:
        raise entries.refusal("length", f"{length:g} m; with these walls at least {thick + 2.0 * corner:g} m")
    count = max(1 if deep else 2, round(between / thick))
    half = between / count
    if 0.0 < deep < 1.5 * thick:
        raise entries.refusal(
            "returns", f"{deep:g} m; 0 for none, or {1.5 * thick:g} m and more, the thickness included"
        )
    if count * entries.si("height") / thick > 4 * MOST_UNITS:
        raise entries.refusal("thickness", f"{thick:g} m makes more than {MOST_UNITS} stones; a first scene has fewer")
    returns = thick + half * max(1, round((deep - thick) / half)) if deep else 0.0
    width = entries.si("door_width")
    if not width:
        return Facade(half, returns, None)
    odd = count % 2  # so that both sides are alike
    door = max(2 - odd, round((width / half - odd) / 2.0) * 2 + odd)
    if door > count - 2:
        raise entries.refusal(
            "door_width", f"{width:g} m; beside it half a stone is needed: at most {half * (count - 2):.4g} m"
        )
    return Facade(half, returns, (corner + half * (count - door) / 2.0, half * door))
