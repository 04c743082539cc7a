"""From a scene's words to the plan of its loading: how many steps, and what happens at each."""

from dataclasses import replace
from math import ceil
from typing import TypeVar

import numpy as np

from masonry.assembly.driven_path import path_in_time
from masonry.errors import SceneError
from masonry.ground.uniform_ground import UniformGround
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.growing import Control, Growing
from masonry.loading.drive.adaptive import Controlled
from masonry.loading.plan import PacedPlan, Plan
from masonry.loading.programs import followed, passage, program, require_few, rise, smooth, steps_at
from masonry.loading.scheduled import Program
from masonry.scene import Scene
from masonry.scene.tables.load_history import Timed

AnyPlan = TypeVar("AnyPlan", bound=Program | PacedPlan)

FEWEST = 2000
"""Steps in which dead loads settle where the scene does not say, and nobody has looked how many they need:
settling_search.py tries so many first."""


TILTED = 1e-7
"""Of gravity: how far it may be from where it is turned to. A row reads its direction ten times as well as 1e-6 rad."""


WAVE = 1e-5
"""Of the largest velocity of a wave: how far it may be from the one that was given."""
WAITING = 1e-3
"""Of its weight: what a layer has before its turn."""
UP_TO = 100.0
"""The factor at which a run ends whose load grows, where the scene does not say."""


def plan_of(scene: Scene, dt: float) -> Plan:
    """The plan for steps of dt (s): a load that grows, a drive that is paced by its error, or a fixed program."""
    if scene.grows:
        return in_layers(scene, growing(scene))
    if scene.is_controlled:
        return in_layers(scene, controlled(scene))
    return program_of(scene, dt)


def growing(scene: Scene) -> Growing:
    """The load of [limit], which grows until nothing balances it."""
    limit, settle = scene.limit, _settle(scene)
    assert limit is not None and limit.run_accuracy is not None
    path = FactorPath(limit.run_accuracy, limit.up_to or UP_TO, limit.history or (), limit.pattern == "tilt")
    control = None if limit.control is None or limit.until is None else Control(limit.control, limit.until)
    return Growing(
        rise(settle, settle) if settle else np.ones(1), path, limit.pattern, control, scene.loops_over, limit.travel
    )


def controlled(scene: Scene) -> Controlled:
    """Dead loads rise over the first half of the settling; then the drive goes along its path, to an accuracy."""
    drive, settle = scene.drive, _settle(scene)
    assert drive is not None and drive.accuracy is not None
    reversals = () if drive.history is None else tuple(drive.sign * place for place in drive.reversals)
    displacement = reversals[0] if reversals else drive.sign * drive.farthest
    return Controlled(rise(settle, settle), displacement, drive.accuracy, reversals)


def program_of(scene: Scene, dt: float) -> Program:
    """Program of drive, dead loads and histories, step by step."""
    plan = with_waves(scene, with_ground(scene, in_layers(scene, _loading(scene, dt)), dt), dt)
    if scene.gravity is not None and scene.gravity.tilt is not None:
        plan = replace(plan, straight=TILTED)
    if scene.solver.until is not None:
        plan = replace(plan, rest_from=plan.steps)
    if (scene.motion or scene.swings) and plan.settle:
        plan = replace(plan, marks=np.union1d(plan.marks, [plan.settle]))
    if scene.solver.duration is not None and not (scene.ground or scene.waves):
        plan = _going_on(plan, _steps_in(scene.solver.duration, dt), dt)
    if scene.samples:
        plan = replace(plan, marks=np.zeros(0, dtype=np.int64), every=steps_between_rows(scene, plan, dt))
    if not scene.has_dead_loads and plan.varying is not None:  # loads that vary act as they are from the first step on
        plan = replace(plan, dead_load=np.ones_like(plan.dead_load))
    if scene.has_dead_loads and plan.settle == 0:  # the first half step of them is in the velocities: motion.begin
        plan = replace(plan, dead_load=np.where(np.arange(plan.steps + 1) > 0, 1.0, 0.0))
    return plan


def uniform_ground(scene: Scene, dt: float) -> UniformGround | None:
    """The motion that all supports share, in time as `with_ground` has it; None without one."""
    ground = scene.ground[0] if len(scene.ground) == 1 else None
    if ground is None or ground.on is not None:
        return None
    return UniformGround(ground.motions, ground.begin + 0.5 * dt, ground.moves_supports)


def steps_between_rows(scene: Scene, plan: Program, dt: float) -> int:
    """Of rows that are equally spaced in time: as many as solver.sampling says, else solver.rows after the settling."""
    if (sampling := scene.sampling) is not None:
        return max(1, int(min(1.0 / (sampling * dt), 1e18)))
    return max(1, (plan.steps - plan.settle) // scene.solver.rows)


def in_layers(scene: Scene, plan: AnyPlan) -> AnyPlan:
    """The plan, where the weight comes on layer by layer, and after it the tractions: one after the other, in the first
    half of the settling. Before its turn a layer has a little of its weight, so that it stays in place."""
    if not scene.comes_in_layers:
        return plan
    assert scene.gravity is not None
    tractions = sum(traction.path is None for traction in scene.traction) + len(scene.fill)
    order = np.append(np.arange(scene.gravity.layers), np.full(tractions, scene.gravity.layers))
    slot = 0.5 * plan.settle / (order[-1] + 1)
    k = np.arange(plan.settle + 1)
    layers = WAITING * smooth(k / slot) + (1.0 - WAITING) * smooth(k / slot - order[:, None])
    return replace(plan, dead_load=np.ones_like(plan.dead_load), layers=layers)


def _steps_in(duration: float, dt: float) -> int:
    """So many steps take a time (s)."""
    if not np.isfinite(dt):
        raise SceneError("solver.time_step: nothing here limits the time step; give one, for example '1e-5 s'")
    return ceil(min(duration / dt, 1e18))


def with_ground(scene: Scene, plan: Program, dt: float) -> Program:
    """The plan, with the ground that moves after the settling: as long as it does, unless the run ends before.

    It begins half a step after the settling, where velocities are known: so nothing of it is lost.
    """
    if not scene.ground:
        return plan
    plan = _going_on_as_long(scene, plan, [ground.runs_for for ground in scene.ground], dt, "ground")
    if scene.shaken is None:
        return replace(plan, base=_velocities_of_base(scene, plan, dt))
    factors, kinks = [], [plan.kinks]
    for motion in scene.shaken.motions.values():
        factor, knots = motion.over_steps(-scene.shaken.begin - 0.5 * dt, dt, plan.steps - plan.settle)
        factors.append(np.concatenate([np.zeros(plan.settle), factor]))
        kinks.append(plan.settle + knots)
    varying = np.array(factors) if plan.varying is None else np.concatenate([plan.varying, factors])
    return replace(plan, varying=varying, kinks=np.unique(np.concatenate(kinks)))


def with_waves(scene: Scene, plan: Program, dt: float) -> Program:
    """The plan, with waves that come in through quiet boundaries: their velocities are factors of stresses."""
    if not scene.waves:
        return plan
    plan = _going_on_as_long(scene, plan, [wave.runs_for for wave in scene.waves], dt, "quiet")
    since = dt * (np.arange(plan.steps - plan.settle + 1) - 0.5)
    factors = [
        np.concatenate([np.zeros(plan.settle), motion.velocity_at(since - wave.begin)])
        for wave in scene.waves
        for motion in wave.motions.values()
    ]
    varying = np.array(factors) if plan.varying is None else np.concatenate([plan.varying, factors])
    return replace(plan, varying=varying, straight=min(plan.straight, WAVE))


def _velocities_of_base(scene: Scene, plan: Program, dt: float) -> np.ndarray:
    """(n + 1, C) m/s of each component, in the middle of the step that follows."""
    since = dt * np.arange(plan.steps - plan.settle + 1)
    moving = [
        motion.velocity_at(since - ground.begin) for ground in scene.moved_grounds for motion in ground.motions.values()
    ]
    return np.pad(np.column_stack(moving), ((plan.settle, 0), (0, 0)))


def _going_on_as_long(scene: Scene, plan: Program, durations: list[float], dt: float, key: str) -> Program:
    """A plan that goes on as long as the longest motion (s) of a table, `key`, unless the scene says when it ends."""
    if scene.solver.duration is not None:
        return _going_on(plan, _steps_in(scene.solver.duration, dt), dt)
    lasts = _steps_in(max(durations), dt) + 1
    return _going_on(plan, max(lasts, plan.steps - plan.settle), dt, key)


def _going_on(plan: Program, steps: int, dt: float, key: str = "solver.duration") -> Program:
    """A plan that ends so many steps after the settling, if it would end before: all loads stay, the drive rests."""
    more = plan.settle + steps - plan.steps
    require_few(plan.settle + steps, dt, key, "shorten it, or make the contacts softer")
    if more < -2:  # counts are rounded up
        raise SceneError(
            f"solver.duration: the drive and the histories of the scene take {(plan.steps - plan.settle) * dt:.6g} s "
            f"after the settling, longer than {steps * dt:.6g} s: no run ends before them"
        )
    if more <= 0:
        return plan
    varying = None if plan.varying is None else np.pad(plan.varying, ((0, 0), (0, more)), mode="edge")
    return replace(
        plan,
        dead_load=np.pad(plan.dead_load, (0, more), mode="edge"),
        speed=np.pad(plan.speed, (0, more)),
        varying=varying,
    )


def tilt_at(scene: Scene, plan: Plan, steps: np.ndarray) -> np.ndarray | None:
    """(n,) rad, by how much gravity is turned at some steps; None where it never is."""
    if scene.gravity is None or scene.gravity.tilt is None or (load_factors := plan.factors_at(steps)) is None:
        return None
    k = [name for name, (_, path) in scene.gravity.parts.items() if path is not None].index("gravity cos")
    shaken = 0 if scene.shaken is None else len(scene.shaken.components)
    shaken += sum(len(wave.components) for wave in scene.waves)
    cos, sin = load_factors[len(load_factors) - shaken - len(scene.gravity.paths) + k :][:2]
    return np.asarray(np.arctan2(sin, cos))


def _loading(scene: Scene, dt: float) -> Program:
    """Settling, and what drive and histories ask for."""
    settle = _settle(scene)
    drive, loads = scene.drive, [path for traction in scene.traction for path in traction.paths]
    if scene.gravity is not None:
        loads += scene.gravity.paths
        if scene.gravity.tilt is not None and scene.gravity.tilt.steps is not None:
            count = scene.gravity.tilt.steps + 1
            require_few(settle + count, dt)
            return followed(dt, settle, np.zeros(count), _load_factors(loads, settle, count))
    if loads or (drive is not None and drive.history is not None):
        return _along_histories(scene, loads, settle, dt)
    if drive is None:
        return program(dt, settle, 0.0, None, None, 0.0)
    return program(dt, settle, drive.sign * drive.farthest, drive.steps, drive.rate, drive.ramp)


def _settle(scene: Scene) -> int:
    """Steps in which the dead loads settle."""
    return scene.settle.steps if scene.settle else FEWEST * scene.has_dead_loads


def _along_histories(scene: Scene, loads: list[Timed], settle: int, dt: float) -> Program:
    """All histories over the same steps: each load's time runs while the drive goes along its whole path."""
    drive = scene.drive
    if drive is not None and drive.history is None:
        plain = program(dt, settle, drive.sign * drive.farthest, drive.steps, drive.rate, drive.ramp)
        require_two(plain.steps - settle)
        return replace(plain, varying=_load_factors(loads, settle, plain.steps - settle))
    path = path_in_time(scene)
    duration = max(history.duration for history in [*loads, *([path] if path else [])]) if loads or path else 0.0
    if drive is not None and drive.steps is not None:
        count = drive.steps
    elif drive is not None and drive.rate is not None:
        count = steps_at(drive.rate, dt, drive.reversals)
    else:
        count = 1 + int(np.ceil(min(duration / dt, 1e18)))
    require_two(count)
    require_few(settle + count, dt)
    t = np.linspace(0.0, duration, count)
    if drive is None:
        places = np.zeros(count)
    else:
        places = drive.sign * (passage(drive.reversals, count) if path is None else _at(path, t) - _at(path, t[:1]))
    return followed(dt, settle, places, _load_factors(loads, settle, count, duration) if loads else None)


def _load_factors(loads: list[Timed], settle: int, count: int, duration: float = 0.0) -> np.ndarray:
    """(H, settle + count + 1) share of each load at each step: all the time of the longest, or `duration` (s) if that
    is longer, passes in the last `count` steps."""
    t = np.linspace(0.0, max(duration, *(load.duration for load in loads)), count)
    return np.array([_at(load, np.concatenate([np.zeros(settle + 1), t])) for load in loads])


def _at(path: Timed, t: np.ndarray) -> np.ndarray:
    """Values (n,) at times, the last one after the end."""
    return np.asarray(path.at(np.minimum(t, path.duration)))


def require_two(count: int) -> None:
    """A history needs a step to start from and one to move in."""
    if count < 2:
        raise SceneError("drive: a history needs two steps at least; give more steps, or a longer duration")
