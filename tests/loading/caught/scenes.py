"""Blocks on a held ground that a growing load moves until bars, stops or other blocks catch them, with both factors."""

from collections.abc import Sequence
from dataclasses import dataclass

from masonry.scene import Scene
from tests.scenes import box, listed, load, specimen, tables

GRAVITY, DENSITY = 9.81, 2000.0
MODULUS, AREA = 210e9, 2e-4
"""Pa and m2, of bars."""
SIDEWAYS = 'pattern = "weight"\ndirection = "x"'
GROUND = (-3.0, -3.0, -0.5), (8.0, 8.0, 0.5)


@dataclass(frozen=True)
class Bar:
    """A bar from a point of a block to one in space, or of another block."""

    first: tuple[float, float, float]
    second: tuple[float, float, float]
    slack: float
    strength: float
    fixed: bool = True

    @property
    def text(self) -> str:
        ends = [[f"{x!r} m" for x in map(float, end)] for end in (self.first, self.second)]
        fixed = 'fixed_end = "second"\n' if self.fixed else ""
        return (
            f'ends = {ends}\n{fixed}area = "{AREA!r} m^2"\nyoung_modulus = "{MODULUS!r} Pa"\n'
            f'strength = "{self.strength / AREA!r} Pa"\nslack = "{self.slack!r} m"'
        ).replace("'", '"')


@dataclass(frozen=True)
class Boxed:
    """A box of a group, with its lowest corner and its size (m); held: whether it is a support."""

    name: str
    low: tuple[float, float, float]
    size: tuple[float, float, float]
    group: str = "units"
    is_support: bool = False

    @property
    def weight(self) -> float:
        x, y, z = self.size
        return DENSITY * GRAVITY * x * y * z


def scene(
    *boxes: Boxed,
    friction: float | dict[str, float],
    limit: str = SIDEWAYS,
    bars: Sequence[Bar] = (),
    large: bool = False,
    accuracy: str = "0.5 %",
    more: str = "",
    kinematics: str = "rigid",
    **changes,
) -> Scene:
    """Boxes on a ground; friction: a tangent, or by names of two groups."""
    boxes = (Boxed("ground", *GROUND, is_support=True), *boxes)
    dry = 'normal_stiffness = "10 GPa/m"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = '
    by_pair = {"unit_unit": friction} if isinstance(friction, float) else friction
    material = f'density = "{DENSITY!r} kg/m^3"'
    if kinematics != "rigid":
        material += '\nyoung_modulus = "20 GPa"\npoisson_ratio = 0.2'
    groups = sorted({one.group for one in boxes})
    return load(
        f'law = "friction"\nkinematics = "{kinematics}"\n'
        + 'displacements = "large"\n' * large
        + specimen(
            [box(one.name, one.low, one.size, one.group, n) for n, one in enumerate(boxes)],
            1.0,
            more='contact_points = "vertex"',
        )
        + tables("material", dict.fromkeys(groups, material))
        + tables("contact", {pair: f"{dry}{tangent!r}" for pair, tangent in by_pair.items()})
        + listed("support", [f'on = "{one.name}"\nfix = "all"' for one in boxes if one.is_support])
        + f'[gravity]\nz = "-{GRAVITY!r} m/s^2"\n'
        + listed("bar", [bar.text for bar in bars])
        + f'[limit]\n{limit}\naccuracy = "{accuracy}"\n{more}',
        **changes,
    )


def push(on: Boxed, at: tuple[float, float, float] | None = None, **along: float) -> str:
    """A force on a block, of its weight times a direction."""
    point = "" if at is None else f"\nat = {[f'{c!r} m' for c in at]}".replace("'", '"')
    force = ", ".join(f'{axis} = "{on.weight * share!r} N"' for axis, share in along.items())
    on = on.name
    return f'pattern = "force"\non = "{on}"\nforce = {{{force}}}{point}'
