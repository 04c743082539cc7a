"""A scene turned or mirrored as a whole, and its blocks numbered anew: blocks, what holds, loads and drives them.

Most beds in masonry lie along an axis, and so do their normals, their corners and the boxes round their blocks. What
is right there by chance is wrong in a scene that is turned; all that a scene does should be the same.
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, nullcontext, suppress
from dataclasses import dataclass, replace
from unittest.mock import patch

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import selected, with_own_points
from geometry.specimens.placed import rotation
from masonry.assembly import assemble, conditions, gauge_places, growing_loads
from masonry.elements.bars.bar_element import BarPlaces
from masonry.elements.forces_at_points import ForcesAtPoints
from masonry.limit_analysis import analysis, contact_strengths
from masonry.limit_analysis.limit_loads import Loads, loads_of
from masonry.model import loads
from masonry.model.gauges import Gauge, Place, gauge
from masonry.model.layout import Layout, lay_out
from masonry.model.model import sort_by_group
from masonry.scene import Scene

SAME = 1e-9
"""By how much a direction, or what is held, may leave the axes that a scene can name."""
Load = dict[str, np.ndarray | None]


class NoSuchScene(Exception):
    """Support or drive of a scene that would lie along no axis once it is turned, which no scene can say."""


@dataclass(frozen=True)
class Turn:
    """Where each point goes, by a matrix (3, 3) whose inverse is its transpose; and a seed that draws the order of the
    blocks, which keep their own without."""

    name: str
    matrix: np.ndarray
    seed: int | None = None

    @property
    def mirrors(self) -> float:
        """-1 where right becomes left, else 1: what turns about an axis, such as a moment, changes its sign then."""
        return float(np.sign(np.linalg.det(self.matrix)))

    def order(self, count: int) -> np.ndarray:
        """(B,) the old number of each block."""
        return np.arange(count) if self.seed is None else np.random.default_rng(self.seed).permutation(count)

    def direction(self, word: str) -> str:
        """Where "x" or "-x" points then. Raises NoSuchScene where that is along no axis."""
        along = self.matrix[:, "xyz".index(word[-1])]
        axis = int(np.argmax(np.abs(along)))
        if abs(along[axis]) < 1.0 - SAME:
            raise NoSuchScene(f"{self.name}: {word} points along no axis")
        return ("-" if (along[axis] < 0.0) != (word[0] == "-") else "") + "xyz"[axis]


def about(axis: tuple[float, float, float], degrees: float) -> np.ndarray:
    """A turn about an axis of any length."""
    unit = np.asarray(axis) / np.linalg.norm(axis)
    return rotation(unit.tolist(), float(np.radians(degrees)))


@contextmanager
def turned(scene: Scene, turn: Turn) -> Iterator[Scene]:
    """The scene that a run or a limit analysis takes for the turned one within. All of its blocks must be rigid.

    Raises NoSuchScene where no scene can say what holds or drives it.
    """
    if any(scene.kinematics_of(group) != "rigid" for group in scene.material):
        raise NoSuchScene(f"{turn.name}: only rigid blocks are turned")
    other, drive = _Turned(scene, turn), scene.drive
    if drive is not None:
        drive = drive.model_copy(update={"direction": turn.direction(drive.direction)})
    with ExitStack() as stack:
        for module, name, method in (
            (assemble, "joined", other.joined),
            (assemble, "conditions_of", other.conditions),
            (assemble, "let_grow", other.let_grow),
            (assemble, "gauges_of", other.gauges),
            (contact_strengths, "joined", other.joined),
            (analysis, "loads_of", other.bodies_and_loads),
        ):
            stack.enter_context(patch.object(module, name, method))
        yield scene.model_copy(update={"drive": drive})


@dataclass(frozen=True)
class _Upright:
    """Parts of a scene that is not turned; and for the turned one the old number of each block, and by block the matrix
    (3, 3) from its old principal axes to its new ones."""

    specimen: Specimen
    joints: Joints
    layout: Layout
    order: np.ndarray
    axes: np.ndarray


class _Turned:
    """Takes the place of what builds a scene: each method builds the scene as it was, and turns what comes of it."""

    def __init__(self, scene: Scene, turn: Turn) -> None:
        self.scene, self.turn, self.first = scene, turn, loads.Conditions({}, {})
        self._joined = assemble.joined

    def joined(self, scene: Scene) -> tuple[Specimen, Joints]:
        """In place of `assemble.joined`: the joints are found anew between the turned blocks."""
        specimen, _ = self._joined(self._old(scene))
        order = self.turn.order(specimen.blocks.count)
        blocks = selected(specimen.blocks, order)
        blocks = replace(blocks, points=blocks.points @ self.turn.matrix.T)
        blocks = mirrored(blocks) if self.turn.mirrors < 0.0 else blocks
        number = np.argsort(order)
        sets = {name: np.sort(number[own]) for name, own in specimen.sets.items()}
        spec = scene.specimen
        points = scene.contact_points, scene.points_per_edge or 2, spec.points_per_face, spec.contact_spacing
        return replace(specimen, blocks=blocks, sets=sets), find_joints(blocks, *points)

    def conditions(
        self, scene: Scene, specimen: Specimen, layout: Layout, joints: Joints, density: np.ndarray, moving: np.ndarray
    ) -> loads.Conditions:
        """In place of `assemble.conditions_of`."""
        old, new = self._upright(layout), loads.no_conditions(layout)
        upright = np.argsort(old.order)
        self.first = there = conditions.conditions_of(
            self.scene, old.specimen, old.layout, old.joints, density[upright], moving[upright]
        )
        new.prescribed, new.supported = self._mask(old, there.prescribed), self._mask(old, there.supported)
        new.held_by = {name: self._mask(old, mask) for name, mask in there.held_by.items()}
        new.load = self._load(old, there.load)
        self._add_loads(old, there, new)
        if scene.drive is not None:
            new.driven = loads.drive_dofs(new.held_by["drive"], scene.drive.axis)
            new.support = loads.drive_dofs(new.supported, scene.drive.axis)
        if there.motion is not None and there.spin is not None:
            moves = self._load(old, dict(there.motion))["rigid"]
            new.motion = {
                kind: part if moves is None or kind != "rigid" else moves for kind, part in there.motion.items()
            }
            new.spin = self.turn.mirrors * there.spin[old.order] @ self.turn.matrix.T
        of_bars = [self._bars(bars, old.order) for bars in there.elements if isinstance(bars, BarPlaces)]
        new.elements = [*of_bars, ForcesAtPoints()]
        return new

    def let_grow(
        self,
        scene: Scene,
        specimen: Specimen,
        joints: Joints,
        layout: Layout,
        density: np.ndarray,
        into: loads.Conditions,
    ) -> None:
        """In place of `assemble.let_grow`."""
        old, there = self._upright(layout), replace(self.first, each_load={}, varying=[])
        growing_loads.let_grow(self.scene, old.specimen, old.joints, old.layout, density[np.argsort(old.order)], there)
        self._add_loads(old, there, into)

    def gauges(self, scene: Scene, specimen: Specimen, joints: Joints, layout: Layout) -> tuple[Gauge, ...]:
        """In place of `assemble.gauges_of`. A gauge that would read along no axis reads along the one that it had.

        Raises NoSuchScene where it is more than watched.
        """
        old, limit = self._upright(layout), self.scene.limit
        number = np.argsort(old.order)
        steers = (self.scene.loops_over, None if limit is None else limit.control)

        def there(place: Place) -> Place:
            return replace(place, block=number[place.block], point=place.point @ self.turn.matrix.T)

        def made(name: str, _: Layout, at: Place, still: Place | None, axis: int, sign: float, quantity: str) -> Gauge:
            word = ("-" if sign < 0.0 else "") + "xyz"[axis]
            with suppress(NoSuchScene) if name not in steers else nullcontext():
                word = self.turn.direction(word)
            base = None if still is None else there(still)
            sign = -1.0 if word[0] == "-" else 1.0
            return gauge(name, layout, there(at), base, "xyz".index(word[-1]), sign, quantity)

        with patch.object(gauge_places, "gauge", made):
            return gauge_places.gauges_of(self.scene, old.specimen, old.joints, old.layout)

    def bodies_and_loads(self, scene: Scene, specimen: Specimen, joints: Joints, dead_alone: bool = False) -> Loads:
        """In place of `analysis.loads_of`: forces, then moments, and what moves, about x, y and z."""
        old, turn = self._joined(self._old(scene)), self.turn
        there, order = loads_of(self.scene, *old, dead_alone), turn.order(old[0].blocks.count)
        bodies = there.bodies

        def load(values: np.ndarray) -> np.ndarray:
            parts = values[order, :3] @ turn.matrix.T, turn.mirrors * values[order, 3:] @ turn.matrix.T
            return np.concatenate(parts, axis=1)

        def mask(values: np.ndarray) -> np.ndarray:
            return np.concatenate([self._directions(values[order, :3]), self._directions(values[order, 3:])], axis=1)

        bodies = replace(
            bodies,
            centre=bodies.centre[order] @ turn.matrix.T,
            free=mask(bodies.free),
            dead=load(bodies.dead),
            live=load(bodies.live),
            together=None if bodies.together is None else mask(bodies.together),
        )
        steady = None if there.steady is None else load(there.steady)
        elements = tuple(self._bars(bars, order) for bars in there.elements if isinstance(bars, BarPlaces))
        return replace(there, bodies=bodies, steady=steady, elements=elements)

    def _old(self, scene: Scene) -> Scene:
        """The scene as it was, with contact points where `scene` has them."""
        return self.scene.model_copy(update={"specimen": scene.specimen})

    def _upright(self, new: Layout) -> _Upright:
        specimen, joints = self._joined(self.scene)
        blocks = with_own_points(specimen.blocks) if self.scene.is_large else specimen.blocks
        layout, order = lay_out(blocks, dict.fromkeys(blocks.groups, "rigid"), None), self.turn.order(blocks.count)
        axes = np.einsum("bji,jk,bkl->bil", new.axes, self.turn.matrix, layout.axes[order])
        return _Upright(replace(specimen, blocks=blocks), sort_by_group(blocks, joints)[2], layout, order, axes)

    def _add_loads(self, old: _Upright, there: loads.Conditions, into: loads.Conditions) -> None:
        """Loads by name; those that vary are the same objects."""
        into.each_load |= {name: self._load(old, load) for name, load in there.each_load.items()}
        for varying in there.varying:
            into.varying += [into.each_load[name] for name, load in there.each_load.items() if load is varying]

    def _load(self, old: _Upright, load: Load) -> Load:
        """Forces along x, y and z, and moments about principal axes; or velocities and spins."""
        if (rows := load["rigid"]) is None:
            return dict(load)
        moments = self.turn.mirrors * np.einsum("bij,bj->bi", old.axes, rows[old.order, 3:])
        return {**load, "rigid": np.concatenate([rows[old.order, :3] @ self.turn.matrix.T, moments], axis=1)}

    def _bars(self, bars: BarPlaces, order: np.ndarray) -> BarPlaces:
        """The same bars between the turned blocks; ends in space are turned as well."""
        block = np.where(bars.block < 0, -1, np.argsort(order)[bars.block])
        return replace(bars, block=block, point=bars.point @ self.turn.matrix.T)

    def _mask(self, old: _Upright, masks: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        rows = masks["rigid"][old.order]
        both = self._directions(rows[:, :3]), self._directions(rows[:, 3:], old.axes)
        return {**masks, "rigid": np.concatenate(both, axis=1)}

    def _directions(self, mask: np.ndarray, matrix: np.ndarray | None = None) -> np.ndarray:
        """(B, 3) which of three axes a mask (B, 3) names once it is turned, by the matrices (B, 3, 3) where given."""
        turn = np.broadcast_to(self.turn.matrix, (len(mask), 3, 3)) if matrix is None else matrix
        onto = np.einsum("bij,bj,bkj->bik", turn, mask.astype(float), turn)
        whole = np.round(np.einsum("bii->bi", onto))
        if np.abs(onto - np.einsum("bi,ij->bij", whole, np.eye(3))).max(initial=0.0) > SAME:
            raise NoSuchScene(f"{self.turn.name}: what is held lies along no axis")
        return np.asarray(whole > 0.5)


def mirrored(blocks: Blocks) -> Blocks:
    """The same points, with the corners of each face the other way round."""
    face = np.repeat(np.arange(len(blocks.face_start) - 1), np.diff(blocks.face_start))
    back = blocks.face_start[face] + blocks.face_start[face + 1] - 1 - np.arange(len(blocks.face_points))
    return replace(blocks, face_points=blocks.face_points[back])
