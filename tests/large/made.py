"""Dry boxes of large displacement on a held slab, loose enough to be computed fast."""

from math import cos, radians, sin

from masonry.jit.compiled_parts import Call
from masonry.kernels.large_step import of_each_kind, patch_forces_on, places_of, velocities_of
from masonry.scene import Scene
from tests.scenes import box, listed, load, specimen, tables

G = 9.81
DENSITY = 2000.0
STIFF = "10 GPa/m"


def dry(
    boxes: list[str],
    friction: float = 0.6,
    gravity: tuple[float, float, float] = (0.0, 0.0, -G),
    duration: float = 0.3,
    turned: str = "",
    more: str = "",
    supports: tuple[str, ...] = ('on = "slab"\nfix = "all"',),
    settle: int = 0,
    rows: int = 200,
    stiff: str = STIFF,
    joint: str = "",
    shear: str = "5 GPa/m",
    changes: dict[str, str | None] | None = None,
) -> Scene:
    """Boxes under a weight along `gravity` (m/s2); the one called slab is held. A `joint` has another law."""
    down = "\n".join(f'{axis} = "{part!r} m/s^2"' for axis, part in zip("xyz", gravity, strict=True))
    contact = (
        f'normal_stiffness = "{stiff}"\nshear_stiffness = "{shear}"\ntan_friction_angle = {friction}\n'
        f"normal_dashpot = 0.5\n{joint}"
    )
    return load(
        'displacements = "large"\nlaw = "friction"\nkinematics = "rigid"\n'
        + specimen(boxes, 0.01, more=turned)
        + tables("material", {"units": f'density = "{DENSITY} kg/m^3"'})
        + tables("contact", {"unit_unit": contact})
        + listed("support", list(supports))
        + f"[gravity]\n{down}\n[settle]\nsteps = {settle}\n"
        + f'[solver]\nmasses = "real"\ndamping = 0\nduration = "{duration} s"\nrows = {rows}\n{more}',
        **(changes or {}),
    )


def leaning(slope: float) -> tuple[float, float, float]:
    """The weight on a plane that falls towards x at a slope (deg), seen from the plane."""
    return G * sin(radians(slope)), 0.0, -G * cos(radians(slope))


def slab(length: float = 4.0) -> str:
    """A flat box whose top is at z = 0."""
    return box("slab", (-0.5 * length, -0.5, -0.1), (length, 1.0, 0.1), "units", 0)


def gathering(model) -> list[Call]:
    """What `gather` calls. To put the calls together takes longer than to make them: a test that gathers in a loop has
    them made once."""
    large, motion = model.large, model.large.near.motion
    places = of_each_kind(places_of, model.bodies, motion, large.members, large.bonds)
    return [*places, *of_each_kind(velocities_of, model.bodies, motion, large.members)]


def gather(model) -> None:
    """As the step does after it has placed the blocks."""
    make(gathering(model))


def hand_over(model) -> None:
    """The forces of the patches to the bodies."""
    make(of_each_kind(patch_forces_on, model.bodies, model.large.near.motion, model.large.members))


def make(calls) -> None:
    for call in calls:
        call()
