"""Does a run apply the load of [limit]? It does so with `limit.accuracy` only: without it the load is for
`masonry limit`, and the answer of a run is that of all other loads alone. With the accuracy "none" that is on purpose,
and the summary says so.

Not asked where something else loads the specimen in the run: a drive, gravity that tilts, a load with a history, ground
that moves, a motion; nor where the weight acts along `limit.direction` already. A vehicle in a run is refused.
"""

from masonry.assembly.assemble import Assembly
from masonry.assembly.growing_loads import VEHICLE_CURE, gravity_of
from masonry.judgement.doubt import Doubt
from masonry.scene import Scene

WORDS = {
    "weight": "the weight along another direction",
    "tilt": "gravity turned about an axis",
    "force": "the force on '{on}'",
    "traction": "the traction on '{on}'",
    "vehicle": "the axles of the vehicle",
}
"""The load of each pattern that a run may leave out."""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One at most."""
    scene = assembly.scene
    limit = scene.limit
    if limit is None or limit.accuracy is not None or (limit.pattern != "vehicle" and is_loaded(scene)):
        return []
    words = WORDS[limit.pattern].format(on=limit.on)
    sentence = f"a run leaves out the load of [limit], {words}: its answer is that of the other loads alone"
    grow = "give limit.accuracy = '1 %' for a run in which it grows"
    if scene.solver.masses == "real" or scene.solver.duration is not None:
        grow = "give limit.accuracy = '1 %' for a run in which it grows, with scaled masses and without a duration"
    advice = f"{grow}; 'none' where only `masonry limit` needs it"
    if scene.vehicle is not None:
        sentence, advice = f"a run leaves out the load of [limit], {words}, and is refused", VEHICLE_CURE
    return [Doubt("load_left_out", None, None, sentence, advice)]


def is_loaded(scene: Scene) -> bool:
    """Whether a run has a load besides dead loads, or one in place of that of [limit]."""
    limit, gravity = scene.limit, scene.gravity
    assert limit is not None
    if limit.pattern == "drive" or scene.drive is not None or scene.ground or scene.quiet or scene.motion:
        return True
    if any(load.paths for load in (*scene.traction, gravity) if load is not None):
        return True
    if limit.pattern != "weight" or limit.direction is None:
        return False
    along = gravity_of(scene)["xyz".index(limit.direction[-1])]
    return bool(along < 0.0 if limit.direction.startswith("-") else along > 0.0)
