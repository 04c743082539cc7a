"""Bodies and loads of a limit analysis from a scene: what is held, what is dead, and what the factor multiplies."""

from dataclasses import dataclass, replace

import numpy as np

from geometry.blocks import Joints, Specimen
from masonry.assembly.assemble import material_of, require_groups
from masonry.assembly.conditions import conditions_of
from masonry.assembly.growing_loads import bed_of, gravity_of, growing_load, pressure_of
from masonry.assembly.masses import density_of
from masonry.assembly.road.axle_pressure import Pressure
from masonry.errors import SceneError
from masonry.model.element_plan import ElementPlan
from masonry.model.layout import Layout, lay_out
from masonry.model.loads import Conditions
from masonry.scene import Scene
from masonry.scene.tables.limit import LimitLoad
from masonry.statics.problem import RigidBodies

PATTERNS = "a table [limit] says what grows, for example pattern = 'weight', direction = 'x'"


@dataclass(frozen=True)
class Loads:
    """bodies, with dead and live loads; words: what the factor multiplies; unit: of the factor, "" for a plain number.

    steady  (B, 6) the dead loads that do not turn where gravity is tilted; None where nothing is
    elements  between the bodies
    """

    bodies: RigidBodies
    words: str
    unit: str = ""
    steady: np.ndarray | None = None
    elements: tuple[ElementPlan, ...] = ()

    def at(self, factor: float) -> RigidBodies:
        """The bodies with all that acts on them at a factor as dead load; a tilt leaves gravity its size."""
        bodies = self.bodies
        if self.steady is None:
            return replace(bodies, dead=bodies.dead + factor * bodies.live)
        tilted = bodies.dead - self.steady + factor * bodies.live
        return replace(bodies, dead=self.steady + tilted / np.hypot(1.0, factor))


def loads_of(scene: Scene, specimen: Specimen, joints: Joints, dead_alone: bool = False) -> Loads:
    """Raises SceneError where nothing grows, where it is not clear what does, or where it moves nothing.

    dead_alone  no load grows, and none needs to be named
    """
    require_groups(scene, specimen.blocks.groups)
    groups = specimen.blocks.groups
    layout = layout_of(specimen)
    materials = {g: material_of(scene, g) for g in groups}
    rigid = scene.model_copy(update={"motion": (), "kinematics": {"default": "rigid"}})
    density, gravity = density_of(scene, specimen, joints, materials), gravity_of(scene)
    conditions = conditions_of(rigid, specimen, layout, joints, density)
    mass = density * layout.volume
    varying = _varying(scene)
    load = None if dead_alone else _growing(scene, varying)
    dead = sum((_loads(conditions, layout, name) for name in _steady(scene, varying)), np.zeros((len(mass), 6)))
    weight = np.zeros_like(dead)
    if "gravity" not in varying:
        weight[:, :3] = mass[:, None] * gravity
    free = ~_held(scene, specimen, layout, conditions)
    together = _driven(scene, conditions) if load is not None and load.pattern == "drive" else None
    if together is not None:
        free |= together
    if load is not None:
        live, words = _live(scene, specimen, joints, layout, load, density, together)
    elif dead_alone:
        live, words = np.zeros_like(dead), "the dead loads"
    else:
        live = sum((_loads(conditions, layout, name) for name in varying), np.zeros_like(dead))
        words = " and ".join(varying) + " at a share of 1"
    bodies = RigidBodies(layout.centroid, free, dead + weight, live, together)
    if not dead_alone and not (live[free] != 0.0).any():
        raise SceneError(f"nothing loads this: {words} acts on no block that can move; {PATTERNS}")
    steady = None if load is None or load.pattern != "tilt" else dead + _along(weight, load)
    return Loads(bodies, words, "" if together is None else "N", steady, tuple(conditions.elements))


def layout_of(specimen: Specimen) -> Layout:
    """All blocks as rigid ones."""
    return lay_out(specimen.blocks, dict.fromkeys(specimen.blocks.groups, "rigid"), None)


def _varying(scene: Scene) -> list[str]:
    """Loads with a history, by name."""
    names = [f"traction.{k}" for k, traction in enumerate(scene.traction) if traction.paths]
    history = scene.gravity is not None and scene.gravity.tilt is None and scene.gravity.paths
    return [*names, "gravity"] if history else names


def _driven(scene: Scene, conditions: Conditions) -> np.ndarray:
    """(B, 6) what the drive moves."""
    assert scene.drive is not None
    fixed = conditions.held_by["drive"]["rigid"]
    return fixed & (np.arange(6) == scene.drive.axis)


def _growing(scene: Scene, varying: list[str]) -> LimitLoad | None:
    """The load that the factor multiplies, of [limit] or else of the scene: None for loads with a history. Raises
    SceneError where it is not clear which."""
    load = scene.limit or _varied(scene, varying)
    if load is not None and varying:
        raise SceneError(
            f"{varying[0]} varies in time, so it is neither dead nor what [limit] names; leave out its history"
        )
    return load


def _varied(scene: Scene, varying: list[str]) -> LimitLoad | None:
    """Load that the scene itself varies: None for loads with a history. Raises SceneError for none, and for several."""
    tilt = scene.gravity.tilt if scene.gravity is not None else None
    sources = [*(["gravity.tilt"] if tilt else []), *(["drive"] if scene.drive else []), *varying[:1]]
    if len(sources) != 1:
        which = f"{' and '.join(sources)} vary" if sources else "nothing in this scene grows"
        raise SceneError(f"{which}, so there is no one load for a factor: {PATTERNS}")
    if tilt is not None:
        about = tilt.about if tilt.angle > 0 else f"-{tilt.about}"
        return LimitLoad.model_validate({"pattern": "tilt", "about": about})
    return LimitLoad(pattern="drive") if scene.drive is not None else None


def _steady(scene: Scene, varying: list[str]) -> list[str]:
    tractions = [name for k in range(len(scene.traction)) if (name := f"traction.{k}") not in varying]
    return [*tractions, *(f"fill.{k}" for k in range(len(scene.fill)))]


def _loads(conditions: Conditions, layout: Layout, name: str) -> np.ndarray:
    """(B, 6) one load at a share of 1, moments about x, y and z."""
    load = conditions.each_load[name]["rigid"]
    return np.zeros((len(layout.kind), 6)) if load is None else _about_axes(load, layout)


def _about_axes(load: np.ndarray, layout: Layout) -> np.ndarray:
    """Moments about principal axes as moments about x, y and z."""
    return np.concatenate([load[:, :3], np.einsum("bij,bj->bi", layout.axes, load[:, 3:])], axis=1)


def _along(weight: np.ndarray, limit: LimitLoad) -> np.ndarray:
    """The part of the weight along the axis of a tilt, which does not turn."""
    part = np.zeros_like(weight)
    if limit.about is not None:
        k = "xyz".index(limit.about[-1])
        part[:, k] = weight[:, k]
    return part


def _live(
    scene: Scene, specimen: Specimen, joints: Joints, layout: Layout, limit: LimitLoad, density: np.ndarray,
    together: np.ndarray | None,
) -> tuple[np.ndarray, str]:  # fmt: skip
    """(B, 6) the load at a factor of 1, and what it is in words."""
    if limit.pattern == "vehicle":
        return _below_vehicle(scene, specimen, joints, layout)
    if limit.pattern != "drive":
        load = growing_load(specimen, joints, layout, limit, density, gravity_of(scene))["rigid"]
        assert load is not None
        return _about_axes(load, layout), limit.words
    assert scene.drive is not None and together is not None
    live = np.zeros((len(density), 6))
    blocks = together[:, scene.drive.axis]
    live[blocks, scene.drive.axis] = scene.drive.sign / max(int(blocks.sum()), 1)
    return live, f"the force of the drive on '{scene.drive.on}' along {scene.drive.direction}"


def _below_vehicle(scene: Scene, specimen: Specimen, joints: Joints, layout: Layout) -> tuple[np.ndarray, str]:
    """(B, 6) of a vehicle that stands somewhere. Raises SceneError where it does not."""
    vehicle = scene.vehicle
    assert vehicle is not None
    if vehicle.position is None:
        raise SceneError("vehicle.position: missing; this analysis loads one place; give it, for example '1.3 m'")
    load = downward(pressure_of(scene, specimen, joints, layout), layout.centroid)
    shares = bed_of(scene, specimen, joints).shares(vehicle, vehicle.position, vehicle.directions[0])
    return load, vehicle.words_with(shares)


def downward(pressure: Pressure, centre: np.ndarray) -> np.ndarray:
    """(B, 6) of forces that press down on blocks whose centres are (B, 3) m."""
    load, force = np.zeros((len(centre), 6)), np.zeros((len(pressure.force), 3))
    force[:, 2] = -pressure.force
    moment = np.cross(pressure.centre - centre[pressure.owner], force)
    np.add.at(load, pressure.owner, np.concatenate([force, moment], axis=1))
    return load


def _held(scene: Scene, specimen: Specimen, layout: Layout, conditions: Conditions) -> np.ndarray:
    """(B, 6) what supports and drive hold, turns about x, y and z.

    Blocks that may deform have no turns of their own to hold: there all that moves along an axis is held, and with it
    the turns about the two others.
    """
    deforms = np.array([scene.deforms(g) for g in specimen.blocks.groups])[specimen.blocks.group]
    fixed = conditions.prescribed["rigid"].copy()
    fixed[:, 3:] = _rotations_about_axes(fixed[:, 3:], layout)
    for by in conditions.held_by.values():
        for k in range(3):
            which = deforms & by["rigid"][:, k]
            fixed[np.ix_(which, [3 + other for other in range(3) if other != k])] = True
    return fixed


def _rotations_about_axes(fixed: np.ndarray, layout: Layout) -> np.ndarray:
    """Turns about principal axes that are held, as turns about x, y and z.

    A scene that holds one or two turns of a block has an axis of it along x, y or z (see masonry/model/supports.py).
    """
    _about_axes = np.repeat(np.all(fixed, axis=1)[:, None], 3, axis=1)
    number = fixed.sum(axis=1).tolist()
    for block in (b for b, rotations in enumerate(number) if rotations in (1, 2)):
        single = number[block] == 1
        odd = int(np.argmax(fixed[block] if single else ~fixed[block]))
        along = int(np.argmax(np.abs(layout.axes[block, :, odd])))
        _about_axes[block] = np.eye(3)[along] == (1.0 if single else 0.0)
    return _about_axes
