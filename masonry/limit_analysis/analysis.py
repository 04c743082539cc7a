"""The limit analysis of a scene: it stands first, then the largest factor, in the way that was asked for."""

from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

import numpy as np

from geometry.blocks import Joints, Specimen
from masonry.errors import SceneError, nearest
from masonry.limit_analysis.contact_strengths import POINTS, contacts_of, mean_stiffness, touching
from masonry.limit_analysis.corner_points import followed, range_of, say_of_corners
from masonry.limit_analysis.element_limits import limit_elements, with_elements
from masonry.limit_analysis.expected import LimitProgress, size_words
from masonry.limit_analysis.limit_loads import Loads, loads_of
from masonry.limit_analysis.limit_result import LimitResult
from masonry.limit_analysis.positions import FactorEnvelope, envelope_of
from masonry.limit_analysis.remarks import (
    CLOSED,
    block_words,
    say_how_exact,
    say_of_jams,
    say_of_slack,
    say_of_sliding,
    say_what_it_is,
    scene_remarks,
)
from masonry.limit_analysis.twists import say_of_twists
from masonry.scene import Scene
from masonry.statics.jammed import jammed
from masonry.statics.plane import plane_of
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.safety import factor_of_safety
from masonry.statics.solve import ANY, STANDS, Method, largest_factor, method_word, standing
from masonry.statics.tilted import tilt_factor

LEAST_SIDES = 3
LESS = 0.005
"""Share by which a factor must fall beyond its peak for a word."""


@dataclass(frozen=True)
class LimitSettings:
    """How a scene is analysed.

    dilation  False: friction without dilation, which gives no bound
    strength  False: no cohesion, no tension
    safety    the factor of safety on friction and cohesion in place of the load factor
    at        the load factor at which safety is asked for
    crushing  Pa, the compressive strength of the joints; None where they bear any pressure
    points    "corners" of the joints, or those of the "scene"
    sides     of the pyramids that take the place of friction cones in space; 0 for cones
    plane     whether a plane problem is solved in its plane
    """

    dilation: bool = True
    strength: bool = True
    safety: bool = False
    at: float = 0.0
    crushing: float | None = None
    points: str = "corners"
    sides: int = 0
    plane: bool = True

    @property
    def beside_crushing(self) -> str:
        """The words of the command that --crushing does not go with."""
        words = {"--linear": self.sides > 0, "--points": self.points != "corners"}
        return " and ".join(word for word, is_there in words.items() if is_there)

    def require_sense(self) -> None:
        """Raises SceneError for words that contradict each other."""
        if self.points not in POINTS:
            raise SceneError(f"points '{self.points}'; {nearest(f'{self.points}', POINTS)}")
        if self.sides and self.sides < LEAST_SIDES:
            raise SceneError(f"a friction pyramid of {self.sides} sides; it needs {LEAST_SIDES} or more")
        if self.crushing is not None and (self.sides or self.points != "corners"):
            raise SceneError("--crushing needs cones, and points at the corners; leave out --linear and --points")
        if self.sides and not self.dilation:
            raise SceneError("--no-dilation needs cones; leave out --linear")
        if self.at and not self.safety:
            raise SceneError("--at is the load factor of --safety; add --safety")


def analyse(
    scene: Scene, wishes: LimitSettings = LimitSettings(), progress: LimitProgress | None = None
) -> LimitResult:
    """The limit analysis of a scene; `progress` is told what it takes, and how far it is.

    Raises SceneError, in one sentence, for what cannot stand, what nothing loads, and what has no limit.
    """
    wishes.require_sense()
    specimen, joints = touching(scene, wishes.points)
    begun = perf_counter()
    contacts = contacts_of(scene, specimen, joints, wishes.strength, wishes.crushing)
    alone = wishes.safety and not wishes.at
    method = Method(wishes.plane, wishes.sides, None if progress is None else progress.tell)
    envelope = None if wishes.safety else _envelope(scene, specimen, joints, contacts, method)
    scene = scene if envelope is None else envelope.standing(scene)
    loads = loads_of(scene, specimen, joints, alone)
    elements = limit_elements(loads.elements)
    contacts = with_elements(contacts, elements, loads.bodies, mean_stiffness(scene, specimen, joints))
    result = LimitResult(scene, specimen, joints, words=loads.words, unit=loads.unit, envelope=envelope)
    result.elements = elements
    if envelope is not None and not wishes.dilation:
        result.remarks.append("the worst position is the one where joints dilate; others may be worse without")
    result.method = method_word(loads.bodies, contacts, method, cones=not wishes.dilation)
    result.points = _points_word(scene, wishes)
    if progress is not None and plane_of(loads.bodies, contacts) is None:
        progress.begin(size_words(contacts, method, wishes.dilation))
    say_what_it_is(result, contacts, result.method, wishes.dilation)
    crushes, other = wishes.crushing is not None, wishes.beside_crushing
    result.remarks += scene_remarks(scene, specimen, joints, contacts, wishes.strength, crushes, other)
    if wishes.crushing is not None:
        result.remarks.append(f"joints bear a compression of {wishes.crushing * 1e-6:g} MPa, as a plastic strength")
    if wishes.safety:
        _set_safety(result, loads, contacts, method, wishes)
    else:
        if loads.bodies.together is None:
            _require_standing(specimen, loads.bodies, contacts, method)
        _set_factor(result, loads, contacts, method, wishes)
    say_of_slack(result)
    say_how_exact(result, loads.bodies)
    result.seconds = perf_counter() - begun
    return result


def _envelope(
    scene: Scene, specimen: Specimen, joints: Joints, contacts: RigidContacts, method: Method
) -> FactorEnvelope | None:
    """The factors of a vehicle that travels, with joints that dilate; None where none does."""
    if scene.limit is None or scene.limit.pattern != "vehicle":
        return None
    if scene.vehicle is None or scene.vehicle.position is not None:
        return None
    loads = loads_of(scene, specimen, joints, dead_alone=True)
    bodies = loads.bodies
    elements = limit_elements(loads.elements)
    contacts = with_elements(contacts, elements, bodies, mean_stiffness(scene, specimen, joints))
    _require_standing(specimen, bodies, contacts, method)
    return envelope_of(scene, specimen, joints, bodies, contacts, method)


def _set_factor(
    result: LimitResult, loads: Loads, contacts: RigidContacts, method: Method, wishes: LimitSettings
) -> None:
    bodies = loads.bodies
    if wishes.dilation:
        solution = _with_dilation(loads, contacts, method)
    else:
        solution = _without_dilation(result, loads, contacts, method)
    if solution.status == "unbounded":
        jams = ", by jamming, which a run decides" if jammed(bodies, contacts, method) else ""
        raise SceneError(f"there is no limit: forces in the joints can balance every factor of {loads.words}{jams}")
    if solution.status != "solved":
        raise SceneError(f"it cannot stand: no factor of {loads.words} balances the dead loads")
    result.take(solution)
    say_of_twists(result, bodies, contacts)
    if not wishes.dilation and wishes.points == "corners" and wishes.crushing is None:
        say_of_corners(result, loads, method, solution.factor, wishes.strength)
    if wishes.dilation:
        say_of_sliding(result, bodies, contacts, solution, cones=not wishes.sides)
    if bodies.together is None:
        say_of_jams(result, bodies, contacts, method)
        if solution.factor <= 1e-9:
            result.remarks.append(f"nothing resists {loads.words}: it moves at the least of it")
    elif wishes.dilation:
        opposite = largest_factor(replace(bodies, live=-bodies.live), contacts, method, ANY)
        if opposite.status == "solved":
            result.least = 0.0 if abs(opposite.factor) <= CLOSED * abs(solution.factor) else -opposite.factor


def _without_dilation(result: LimitResult, loads: Loads, contacts: RigidContacts, method: Method) -> Solution:
    """The factor where what slides does not rise, with what the result says of how it was found."""
    flat = followed(loads, contacts, method)
    solution = flat.solution
    result.with_dilation, result.steps = flat.with_dilation, flat.steps
    result.excess, result.open = flat.excess, flat.open
    if flat.end_factor < (1.0 - LESS) * solution.factor:
        result.remarks.append(
            f"what slides loses the pressure that held it: of the greatest factor {flat.end_factor:.5g} is left then"
        )
    if not flat.converged and solution.status == "solved":
        result.remarks.append(
            f"the factor came to no rest in {flat.steps} steps: the normal forces at the end bear up to "
            f"{(1.0 + flat.open) * solution.factor:.5g}; take no more digits than these two share"
        )
    return solution


def _with_dilation(loads: Loads, contacts: RigidContacts, method: Method) -> Solution:
    if loads.steady is None:
        return largest_factor(loads.bodies, contacts, method, range_of(loads))
    return tilt_factor(loads.bodies, contacts, loads.steady, method)


def _set_safety(
    result: LimitResult, loads: Loads, contacts: RigidContacts, method: Method, wishes: LimitSettings
) -> None:
    loaded = loads.at(wishes.at)
    if not (loaded.dead[loaded.free] != 0.0).any():
        raise SceneError("nothing loads this, so there is no factor of safety; add [gravity], a traction, or --at")
    factor, _, mechanism = factor_of_safety(loaded, contacts, method, wishes.dilation)
    if not wishes.dilation:
        result.with_dilation = _safety_with_dilation(loaded, contacts, method)
    still = replace(loaded, live=np.zeros_like(loaded.live))
    if wishes.dilation:
        say_of_sliding(result, still, contacts, mechanism, cones=not wishes.sides)
    say_of_jams(result, still, contacts, method)
    result.take(replace(mechanism, factor=factor))
    result.is_safety, result.at = True, wishes.at
    result.words = f"friction and cohesion over it balance {result.words}" + (
        f" at a factor of {wishes.at:g}" if wishes.at else ""
    )


def _safety_with_dilation(loaded: RigidBodies, contacts: RigidContacts, method: Method) -> float:
    """The factor of safety of joints that dilate, beside that of joints that do not; inf where the least of friction is
    enough for them."""
    try:
        return factor_of_safety(loaded, contacts, method)[0]
    except SceneError:
        return inf


def _require_standing(specimen: Specimen, bodies: RigidBodies, contacts: RigidContacts, method: Method) -> None:
    """The dead loads alone must be balanced."""
    if not (bodies.dead[bodies.free] != 0.0).any():
        return
    solution = standing(bodies, contacts, method)
    if solution.status == "solved" and solution.factor >= STANDS:
        return
    reach = np.linalg.norm(solution.velocity[:, :3], axis=1)
    first = int(np.argmax(reach))
    what = block_words(specimen, bodies, first)
    balanced = f"{solution.factor:.3g} of them is balanced" if solution.factor > 1e-6 else "nothing of them is balanced"
    raise SceneError(f"it cannot stand under its dead loads: {balanced}, and {what} is the first to move")


def _points_word(scene: Scene, wishes: LimitSettings) -> str:
    if wishes.points == "corners":
        return "the corners of the joints, which bear what any pressure without tension bears"
    return f"those of the scene ({scene.specimen.contact_points})"
