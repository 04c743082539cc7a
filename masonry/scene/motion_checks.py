"""Do the keys of motion, weight that varies, limit analysis and large displacement fit to the rest of a scene?"""

from typing import Any

from masonry.errors import nearest
from masonry.scene.tables.types import KeyedError
from masonry.scene.variant import LIMITS

STEPS_A_LAYER = 20
"""Of the settling, at least, for each layer in which the weight comes on."""


def require_fit(scene: Any) -> None:
    """KeyedError for the first key of a scene (SceneData) that contradicts another one."""
    _large_only(scene)
    if scene.is_large:
        for key in LIMITS:
            if key in scene.solver.model_fields_set:
                raise KeyedError(f"solver.{key}", "a run of large displacement does not stop there; leave it out")
    if scene.scatter is not None and "default" in scene.scatter.groups:
        raise KeyedError("scatter.default", "scatter needs a group of its own, with its own table of contacts")
    if scene.limit is not None:
        _limit(scene)
    _real_time(scene)
    if scene.damping is not None:
        _damping(scene)
    if scene.gravity is not None:
        _gravity(scene)
    _shaking(scene)
    if scene.fill:
        _fill(scene)
    for k, bar in enumerate(scene.bar):
        if bar.fixed_end is not None and scene.ground:
            raise KeyedError(
                f"bar.{k}.fixed_end",
                "stays in space, while [ground] moves all that supports hold: let it end in a block that a [[support]] "
                "holds",
            )
    if scene.vehicle is not None and (scene.limit is None or scene.limit.pattern != "vehicle"):
        raise KeyedError("vehicle", "its axles are what a factor multiplies: give [limit] pattern = 'vehicle'")


def _fill(scene: Any) -> None:
    """A fill has weight alone, and it presses straight down."""
    gravity = scene.gravity
    if gravity is None or gravity.z >= 0.0 or gravity.x != 0.0 or gravity.y != 0.0:
        raise KeyedError(
            "fill.0", "a fill presses by its weight along -z: give [gravity] with a z below 0, and no x or y"
        )
    if gravity.paths:
        raise KeyedError("fill.0", "a fill stays as heavy as it is; leave out history and tilt of [gravity]")
    if scene.limit is not None and scene.limit.pattern in ("weight", "tilt"):
        raise KeyedError(
            "limit.pattern",
            f"{scene.limit.pattern} would leave out the mass of the fill; take force, traction or drive",
        )


def _limit(scene: Any) -> None:
    """The load of a limit analysis is made of what the scene has."""
    pattern, gravity = scene.limit.pattern, scene.gravity
    if pattern in ("weight", "tilt") and gravity is None:
        raise KeyedError("limit.pattern", f"'{pattern}' needs weight: a table [gravity]")
    for table in ("drive", "vehicle"):
        if pattern == table and getattr(scene, table) is None:
            raise KeyedError("limit.pattern", f"'{table}' needs a table [{table}]")
    if pattern == "tilt":
        about = scene.limit.about[-1]
        if not any(g for axis, g in zip("xyz", gravity.vector, strict=True) if axis != about):
            raise KeyedError("limit.about", f"gravity acts along {about} alone: turning it changes nothing")
    if scene.grows:
        _grows(scene)


def _grows(scene: Any) -> None:
    """In a run whose load grows until nothing balances it, all other loads stay, and time means nothing."""
    if scene.limit.pattern == "vehicle" and scene.vehicle.position is None:
        raise KeyedError(
            "vehicle.position",
            "missing; a run loads one place: `masonry limit` finds the worst one; give it, for example '1.3 m'",
        )
    alone = "the load of [limit] grows alone, paced by what the specimen does; leave this out, or limit.accuracy"
    if scene.drive is not None:
        raise KeyedError("drive", alone)
    for k, traction in enumerate(scene.traction):
        if traction.paths:
            raise KeyedError(f"traction.{k}.history", alone)
    if scene.gravity is not None and scene.gravity.paths:
        raise KeyedError("gravity.tilt" if scene.gravity.tilt is not None else "gravity.history", alone)
    for key, is_there in {"ground": scene.ground, "quiet": scene.quiet}.items():
        if is_there:
            raise KeyedError(key, alone)
    for key, is_there in {
        "motion.0": bool(scene.motion),
        "damping": scene.damping is not None,
        "solver.masses": scene.solver.masses == "real",
        "solver.duration": scene.solver.duration is not None,
        "solver.until": scene.solver.until is not None,
        "solver.damping": scene.solver.damping == 0.0,
        **_in_real_time(scene),
    }.items():
        if is_there:
            raise KeyedError(key, "a load that grows is balanced by damped motion with scaled masses; leave it out")


def _large_only(scene: Any) -> None:
    """Check of keys that only contacts found anew can have."""
    only = 'needs displacements = "large" at the top of the file'
    if scene.is_large:
        return
    for group, contact in scene.contact.items():
        if contact.normal_dashpot is not None:
            raise KeyedError(f"contact.{group}.normal_dashpot", f"{only}; solver.damping serves both")
        if contact.restitution is not None:
            raise KeyedError(f"contact.{group}.restitution", f"{only}; [damping] serves both, with real masses")
    for k, traction in enumerate(scene.traction):
        if traction.stays_in_space:
            raise KeyedError(f"traction.{k}.line_of_action", f"{only}; in small displacement no load changes its place")
    if "default" in scene.contact:
        raise KeyedError("contact.default", f"{only}; name the groups of contacts, such as [contact.unit_unit]")
    if scene.solver.until is not None:
        real = scene.solver.masses == "real" or _is_timed(scene)
        also = "" if real else ", masses = 'real' and a duration such as '10 s' in [solver]"
        raise KeyedError("solver.until", f"{only}{also}; small displacements end with their loading or their duration")
    for key in ("patch_points", "patch_points_per_edge"):
        if getattr(scene.specimen, key) is not None:
            raise KeyedError(f"specimen.{key}", f"{only}; contact_points says where points of small displacements lie")
    if scene.solver.skin is not None:
        raise KeyedError("solver.skin", f"{only}; a run of small displacements looks for contacts once")


def _real_time(scene: Any) -> None:
    """Times, velocities and ratios of damping are those of real masses."""
    if scene.solver.masses != "real":
        _of_real_masses(scene)
    if scene.solver.sampling is not None and "rows" in scene.solver.model_fields_set:
        raise KeyedError("solver.sampling", "rows and sampling exclude each other; keep one of them")
    ends = _is_timed(scene) or scene.solver.duration is not None
    if scene.motion and not ends:
        raise KeyedError("solver.duration", "missing; without a drive it says how long the run takes, such as '2 s'")
    if scene.solver.until is not None and not ends:
        real = "" if scene.solver.masses == "real" else ", and solver.masses = 'real'"
        raise KeyedError("solver.duration", f"missing; until = 'rest' needs it: the latest end, such as '10 s'{real}")


def _is_timed(scene: Any) -> bool:
    """Whether what loads it says how long a run takes."""
    varies = any(load.paths for load in (*scene.traction, scene.gravity) if load is not None)
    return scene.drive is not None or bool((*scene.ground, *scene.waves)) or varies


def _in_real_time(scene: Any) -> dict[str, bool]:
    """Keys that only a motion in real time has, and whether they are there."""
    return {
        "solver.sampling": scene.solver.sampling is not None,
        "curve.x": scene.curve is not None and scene.curve.x == "time",
        **{f"gauge.{k}.quantity": gauge.quantity != "displacement" for k, gauge in enumerate(scene.gauge)},
    }


def _of_real_masses(scene: Any) -> None:
    """Check of keys that scaled masses cannot have."""
    real = "needs solver.masses = 'real': scaled masses do not move in real time"
    own_time = {
        "solver.duration": scene.solver.duration is not None,
        "damping": scene.damping is not None,
        **_in_real_time(scene),
    }
    for key, is_there in own_time.items():
        if is_there:
            raise KeyedError(key, real)
    if scene.motion:
        ends = "" if _is_timed(scene) else ", and a solver.duration such as '2 s'"
        raise KeyedError("motion.0", f"needs solver.masses = 'real'{ends}: scaled masses do not move in real time")
    if scene.settle is not None and scene.settle.steps == 0:
        raise KeyedError("settle.steps", f"0 {real}; give 1 or more, or leave the table out")


def _shaking(scene: Any) -> None:
    """Checks of the ground and of the quiet boundaries that shake a scene."""
    if scene.ground:
        _ground(scene)
    if scene.quiet:
        _quiet(scene)


def _ground(scene: Any) -> None:
    """Ground that moves: real masses, something that it holds, and one frame or supports of their own."""
    if scene.solver.masses == "scaled":
        raise KeyedError(
            "solver.masses",
            "ground that moves shakes real masses: scaled ones would answer with other forces of inertia; "
            "say 'real', or leave it out",
        )
    if scene.is_controlled:
        raise KeyedError("drive.accuracy", "takes no time; beside [ground] give drive.rate, or a history with times")
    if not scene.support and scene.floor is None:
        raise KeyedError("ground", "nothing stands on the ground: give a table [[support]], or a [floor]")
    _each_ground(scene)
    names = [ground.on for ground in scene.ground]
    if len(set(names)) < len(names):
        raise KeyedError("ground", "two of them move the same support; keep one, with all its components")


def _quiet(scene: Any) -> None:
    """Waves in real time, which bring the motion of the ground themselves; a dashpot bears no weight."""
    if scene.solver.masses == "scaled":
        raise KeyedError(
            "solver.masses", "waves run in real time: scaled masses have others; say 'real', or leave it out"
        )
    if scene.is_controlled:
        raise KeyedError("quiet", "an accuracy controls the drive only; give drive.steps or drive.rate")
    if scene.ground:
        raise KeyedError("quiet", "ground that moves as a whole has no waves: keep [ground], or give quiet.wave")
    if scene.has_dead_loads and not scene.support and scene.floor is None:
        raise KeyedError("quiet", "bears no weight, as dashpots do not: add a [[support]] that holds along the weight")


def _each_ground(scene: Any) -> None:
    """Check of the supports that each of several grounds moves."""
    held = [*(support.on for support in scene.support), *(["floor"] if scene.floor is not None else [])]
    alone = len(scene.ground) == 1
    for k, ground in enumerate(scene.ground):
        own = "ground" if alone else f"ground.{k}"
        if ground.on is None and not alone:
            raise KeyedError(f"{own}.on", "missing; where several move apart, each names its support")
        if not ground.moves_supports and ground.on is not None:
            raise KeyedError(f"{own}.as", "supports that move apart have no frame in common: as = 'base'")
        if ground.on is not None and ground.on not in held:
            raise KeyedError(f"{own}.on", f"'{ground.on[:60]}' is no support; {nearest(ground.on, held)}")
        if ground.moves_supports and scene.drive is not None:
            raise KeyedError("drive", "supports that move leave no room for a drive; take ground.as = 'inertia'")


def _damping(scene: Any) -> None:
    """Check of damping relative to the ground; a drive, and supports that move, carry the specimen along."""
    if scene.damping.brakes_all is None:
        return
    key = f"damping.{scene.damping.brakes_all}"
    if scene.drive is not None:
        raise KeyedError(key, "brakes motion relative to the ground, not to a drive: give a [ground] instead")
    if scene.moved_grounds:
        raise KeyedError(key, "brakes motion relative to the ground, which is at rest with ground.as = 'inertia' only")


def _gravity(scene: Any) -> None:
    if scene.comes_in_layers and scene.settle is not None and scene.settle.steps < STEPS_A_LAYER * scene.gravity.layers:
        least = STEPS_A_LAYER * scene.gravity.layers
        raise KeyedError("settle.steps", f"too few for {scene.gravity.layers} layers of weight; give {least} or more")
    if scene.gravity.paths and scene.is_controlled:
        key = "gravity.tilt" if scene.gravity.tilt is not None else "gravity.history"
        raise KeyedError(key, "an accuracy controls the drive only; give drive.steps or drive.rate")
    tilt = scene.gravity.tilt
    if tilt is None:
        return
    if tilt.steps is not None and (scene.drive is not None or any(load.paths for load in scene.traction)):
        raise KeyedError("gravity.tilt.steps", "with a drive, or a traction that varies, give a duration in its place")
