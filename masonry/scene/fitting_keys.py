"""Do the keys of motion, weight that varies, limit analysis and large displacement fit to the rest of a scene?"""

from collections.abc import Iterator

from masonry.errors import nearest
from masonry.scene.schema import SceneKeys
from masonry.scene.tables.gravity_and_floor import Gravity
from masonry.scene.tables.limit import LimitLoad
from masonry.scene.tables.types import KeyedError
from masonry.scene.variant import LIMITS

STEPS_A_LAYER = 20
"""Of the settling, at least, for each layer in which the weight comes on."""
Row = tuple[object, str, str]
"""Whether a key does not fit, the key, and why it does not."""


def require_fit(scene: SceneKeys) -> None:
    """KeyedError for the first key of a scene that contradicts another one."""
    for part in (
        _displacements,
        _limit,
        _real_time,
        _damping,
        _gravity,
        _ground,
        _quiet,
        _fill,
        _bars_and_vehicle,
    ):
        for is_wrong, key, words in part(scene):
            if is_wrong:
                raise KeyedError(key, words)


def _displacements(scene: SceneKeys) -> Iterator[Row]:
    """Keys that only contacts found anew can have, and those that only others can."""
    if scene.is_large:
        for key in LIMITS:
            is_there = key in scene.solver.model_fields_set
            yield is_there, f"solver.{key}", "a run of large displacement does not stop there; leave it out"
    else:
        yield from _large_only(scene)
    scattered = scene.scatter.groups if scene.scatter is not None else {}
    yield "default" in scattered, "scatter.default", "scatter needs a group of its own, with its own table of contacts"


def _large_only(scene: SceneKeys) -> Iterator[Row]:
    only = 'needs displacements = "large" at the top of the file'
    for group, contact in scene.contact.items():
        words = f"{only}; solver.damping serves both"
        yield contact.normal_dashpot is not None, f"contact.{group}.normal_dashpot", words
        words = f"{only}; [damping] serves both, with real masses"
        yield contact.restitution is not None, f"contact.{group}.restitution", words
    words = f"{only}; in small displacement no load changes its place"
    for k, traction in enumerate(scene.traction):
        yield traction.stays_in_space, f"traction.{k}.line_of_action", words
    words = f"{only}; name the groups of contacts, such as [contact.unit_unit]"
    yield "default" in scene.contact, "contact.default", words
    real = scene.solver.masses == "real" or _is_timed(scene)
    also = "" if real else ", masses = 'real' and a duration such as '10 s' in [solver]"
    words = f"{only}{also}; small displacements end with their loading or their duration"
    yield scene.solver.until is not None, "solver.until", words
    words = f"{only}; contact_points says where points of small displacements lie"
    for key in ("patch_points", "patch_points_per_edge"):
        yield getattr(scene.specimen, key) is not None, f"specimen.{key}", words
    yield scene.solver.skin is not None, "solver.skin", f"{only}; a run of small displacements looks for contacts once"


def _limit(scene: SceneKeys) -> Iterator[Row]:
    """The load of a limit analysis is made of what the scene has."""
    if (limit := scene.limit) is None:
        return
    pattern, gravity = limit.pattern, scene.gravity
    words = f"'{pattern}' needs weight: a table [gravity]"
    yield pattern in ("weight", "tilt") and gravity is None, "limit.pattern", words
    for table in ("drive", "vehicle"):
        yield pattern == table and getattr(scene, table) is None, "limit.pattern", f"'{table}' needs a table [{table}]"
    if pattern == "tilt" and gravity is not None and limit.about is not None:
        about = limit.about[-1]
        words = f"gravity acts along {about} alone: turning it changes nothing"
        across = [g for axis, g in zip("xyz", gravity.vector, strict=True) if axis != about]
        yield not any(across), "limit.about", words
    if scene.grows:
        yield from _grows(scene, limit)


def _grows(scene: SceneKeys, limit: LimitLoad) -> Iterator[Row]:
    """In a run whose load grows until nothing balances it, all other loads stay, and time means nothing."""
    travels = limit.pattern == "vehicle" and scene.vehicle is not None and scene.vehicle.position is None
    words = "missing; a run loads one place: `masonry limit` finds the worst one; give it, for example '1.3 m'"
    yield travels, "vehicle.position", words
    alone = "the load of [limit] grows alone, paced by what the specimen does; leave this out, or limit.accuracy"
    yield scene.drive is not None, "drive", alone
    for k, traction in enumerate(scene.traction):
        yield traction.paths, f"traction.{k}.history", alone
    if scene.gravity is not None:
        yield scene.gravity.paths, _key_of_paths(scene.gravity), alone
    yield scene.ground, "ground", alone
    yield scene.quiet, "quiet", alone
    damped = "a load that grows is balanced by damped motion with scaled masses; leave it out"
    yield scene.motion, "motion.0", damped
    yield scene.damping is not None, "damping", damped
    yield scene.solver.masses == "real", "solver.masses", damped
    yield scene.solver.duration is not None, "solver.duration", damped
    yield scene.solver.until is not None, "solver.until", damped
    yield scene.solver.damping == 0.0, "solver.damping", damped
    for is_there, key in _in_real_time(scene):
        yield is_there, key, damped


def _real_time(scene: SceneKeys) -> Iterator[Row]:
    """Times, velocities and ratios of damping are those of real masses."""
    solver, timed = scene.solver, _is_timed(scene)
    if solver.masses != "real":
        yield from _of_real_masses(scene, timed)
    both = solver.sampling is not None and "rows" in solver.model_fields_set
    yield both, "solver.sampling", "rows and sampling exclude each other; keep one of them"
    endless = not timed and solver.duration is None
    words = "missing; without a drive it says how long the run takes, such as '2 s'"
    yield scene.motion and endless, "solver.duration", words
    real = "" if solver.masses == "real" else ", and solver.masses = 'real'"
    words = f"missing; until = 'rest' needs it: the latest end, such as '10 s'{real}"
    yield solver.until is not None and endless, "solver.duration", words


def _of_real_masses(scene: SceneKeys, timed: bool) -> Iterator[Row]:
    """Keys that scaled masses cannot have."""
    real = "needs solver.masses = 'real': scaled masses do not move in real time"
    yield scene.solver.duration is not None, "solver.duration", real
    yield scene.damping is not None, "damping", real
    for is_there, key in _in_real_time(scene):
        yield is_there, key, real
    ends = "" if timed else ", and a solver.duration such as '2 s'"
    yield scene.motion, "motion.0", f"needs solver.masses = 'real'{ends}: scaled masses do not move in real time"
    stays = scene.settle is not None and scene.settle.steps == 0
    yield stays, "settle.steps", f"0 {real}; give 1 or more, or leave the table out"


def _in_real_time(scene: SceneKeys) -> Iterator[tuple[bool, str]]:
    """Keys that only a motion in real time has, and whether they are there."""
    yield scene.solver.sampling is not None, "solver.sampling"
    yield scene.curve is not None and scene.curve.x == "time", "curve.x"
    for k, gauge in enumerate(scene.gauge):
        yield gauge.quantity != "displacement", f"gauge.{k}.quantity"


def _is_timed(scene: SceneKeys) -> bool:
    """Whether what loads it says how long a run takes."""
    varies = any(load.paths for load in (*scene.traction, scene.gravity) if load is not None)
    return scene.drive is not None or bool((*scene.ground, *scene.waves)) or varies


def _damping(scene: SceneKeys) -> Iterator[Row]:
    """Damping relative to the ground; a drive, and supports that move, carry the specimen along."""
    if scene.damping is None or scene.damping.brakes_all is None:
        return
    key = f"damping.{scene.damping.brakes_all}"
    yield scene.drive is not None, key, "brakes motion relative to the ground, not to a drive: give a [ground] instead"
    words = "brakes motion relative to the ground, which is at rest with ground.as = 'inertia' only"
    yield scene.moved_grounds, key, words


def _gravity(scene: SceneKeys) -> Iterator[Row]:
    if (gravity := scene.gravity) is None:
        return
    least = STEPS_A_LAYER * gravity.layers
    few = scene.comes_in_layers and scene.settle is not None and scene.settle.steps < least
    yield few, "settle.steps", f"too few for {gravity.layers} layers of weight; give {least} or more"
    words = "an accuracy controls the drive only; give drive.steps or drive.rate"
    yield gravity.paths and scene.is_controlled, _key_of_paths(gravity), words
    stepped = gravity.tilt is not None and gravity.tilt.steps is not None
    timed = scene.drive is not None or any(load.paths for load in scene.traction)
    words = "with a drive, or a traction that varies, give a duration in its place"
    yield stepped and timed, "gravity.tilt.steps", words


def _key_of_paths(gravity: Gravity) -> str:
    """The key by which gravity varies."""
    return "gravity.tilt" if gravity.tilt is not None else "gravity.history"


def _ground(scene: SceneKeys) -> Iterator[Row]:
    """Ground that moves: real masses, something that it holds, and one frame or supports of their own."""
    if not scene.ground:
        return
    words = (
        "ground that moves shakes real masses: scaled ones would answer with other forces of inertia; "
        "say 'real', or leave it out"
    )
    yield scene.solver.masses == "scaled", "solver.masses", words
    words = "takes no time; beside [ground] give drive.rate, or a history with times"
    yield scene.is_controlled, "drive.accuracy", words
    words = "nothing stands on the ground: give a table [[support]], or a [floor]"
    yield not scene.support and scene.floor is None, "ground", words
    yield from _each_ground(scene)
    names = [ground.on for ground in scene.ground]
    yield len(set(names)) < len(names), "ground", "two of them move the same support; keep one, with all its components"


def _each_ground(scene: SceneKeys) -> Iterator[Row]:
    """The supports that each of several grounds moves."""
    held = [*(support.on for support in scene.support), *(["floor"] if scene.floor is not None else [])]
    alone = len(scene.ground) == 1
    for k, ground in enumerate(scene.ground):
        own = "ground" if alone else f"ground.{k}"
        yield ground.on is None and not alone, f"{own}.on", "missing; where several move apart, each names its support"
        if ground.on is not None:
            words = "supports that move apart have no frame in common: as = 'base'"
            yield not ground.moves_supports, f"{own}.as", words
            yield ground.on not in held, f"{own}.on", f"'{ground.on[:60]}' is no support; {nearest(ground.on, held)}"
        words = "supports that move leave no room for a drive; take ground.as = 'inertia'"
        yield ground.moves_supports and scene.drive is not None, "drive", words


def _quiet(scene: SceneKeys) -> Iterator[Row]:
    """Waves in real time, which bring the motion of the ground themselves; a dashpot bears no weight."""
    if not scene.quiet:
        return
    words = "waves run in real time: scaled masses have others; say 'real', or leave it out"
    yield scene.solver.masses == "scaled", "solver.masses", words
    yield scene.is_controlled, "quiet", "an accuracy controls the drive only; give drive.steps or drive.rate"
    yield scene.ground, "quiet", "ground that moves as a whole has no waves: keep [ground], or give quiet.wave"
    sinks = scene.has_dead_loads and not scene.support and scene.floor is None
    yield sinks, "quiet", "bears no weight, as dashpots do not: add a [[support]] that holds along the weight"


def _fill(scene: SceneKeys) -> Iterator[Row]:
    """A fill has weight alone, and it presses straight down."""
    if not scene.fill:
        return
    gravity = scene.gravity
    words = "a fill presses by its weight along -z: give [gravity] with a z below 0, and no x or y"
    yield gravity is None or gravity.z >= 0.0 or gravity.x != 0.0 or gravity.y != 0.0, "fill.0", words
    words = "a fill stays as heavy as it is; leave out history and tilt of [gravity]"
    yield gravity is not None and gravity.paths, "fill.0", words
    if scene.limit is not None:
        words = f"{scene.limit.pattern} would leave out the mass of the fill; take force, traction or drive"
        yield scene.limit.pattern in ("weight", "tilt"), "limit.pattern", words


def _bars_and_vehicle(scene: SceneKeys) -> Iterator[Row]:
    words = (
        "stays in space, while [ground] moves all that supports hold: let it end in a block that a [[support]] holds"
    )
    for k, bar in enumerate(scene.bar):
        yield bar.fixed_end is not None and scene.ground, f"bar.{k}.fixed_end", words
    words = "its axles are what a factor multiplies: give [limit] pattern = 'vehicle'"
    idle = scene.vehicle is not None and (scene.limit is None or scene.limit.pattern != "vehicle")
    yield idle, "vehicle", words
