"""From a scene's words to the dofs they mean: supports, drive, tractions, gravity, and what they select."""

import re
from collections.abc import Iterable
from contextlib import suppress

import numpy as np

from geometry.blocks import GeometryError, Joints, Specimen
from geometry.joints import boundary
from geometry.specimens.placed import FLOOR
from masonry.assembly.bars.bar_places import bar_places_of
from masonry.assembly.road.fill import columns_of, weight_of
from masonry.elements.forces_at_points import ForcesAtPoints
from masonry.elements.moved_supports import MovedDofs
from masonry.elements.quiet_faces import Drag, add_face
from masonry.errors import SceneError, nearest
from masonry.model import loads
from masonry.model.kinds import KIND, velocities_of
from masonry.model.layout import DOFS, KINDS, Layout, Material
from masonry.model.supports import Hold, held_dofs
from masonry.quantity import parse
from masonry.scene import Scene
from masonry.scene.tables.dynamics.quiet_boundary import QuietBoundary
from masonry.scene.tables.loads_and_supports import Drive
from masonry.scene.tables.types import ALSO, PLANE

AXES = {"x": 0, "y": 1, "z": 2}
SHOWN = ("z+", "z-", "x+", "x-", "y+", "y-")
"""Directions of faces, in the order in which a message looks for one that there is."""
WHOLE_BLOCKS = ("motion", "vehicle", "fill", "mass")
"""Tables that select whole blocks, and no faces."""


def conditions_of(
    scene: Scene,
    specimen: Specimen,
    layout: Layout,
    joints: Joints,
    density: np.ndarray,
    moving_density: np.ndarray | None = None,
) -> loads.Conditions:
    """Supports, drive and dead loads on the dofs; density (B,) kg/m3 of the blocks (masses.density_of), and of what
    moves with them (masses.moving_density_of) where that is more."""
    conditions = loads.no_conditions(layout)
    _add_supports(scene, specimen, joints, layout, conditions)
    moved = _moved_supports(scene, conditions)
    if scene.drive is not None:
        _add_drive(scene.drive, specimen, joints, layout, conditions)
    for k, traction in enumerate(scene.traction):
        where = f"traction.{k}.on"
        _, faces = select(specimen, joints, traction.on, where)
        if faces is None:
            example = example_of(specimen, joints, traction.on)
            raise SceneError(f"{where} = '{traction.on}': a traction acts on a face{example}")
        if traction.stays_in_space and layout.deforms[specimen.blocks.face_block()[faces]].any():
            raise SceneError(
                f"traction.{k}.line_of_action = 'fixed': {where} = '{traction.on}' are blocks that deform; a load that "
                "stays in place acts on rigid ones, such as a beam on top"
            )
        load, push = dict.fromkeys(KINDS), loads.Push(faces, np.array(traction.stress))
        loads.add_traction(specimen.blocks, layout, load, push)
        conditions.at_points[f"traction.{k}"] = loads.points_of(specimen.blocks, layout, push, traction.stays_in_space)
        _add_load(layout, conditions, f"traction.{k}", load, varies=traction.path is not None)
    _add_weight(scene, specimen, layout, conditions, density)
    _add_inertia(scene, specimen, layout, conditions, density if moving_density is None else moving_density)
    quiet = [_quiet_faces(scene, specimen, joints, layout, conditions)] if scene.quiet else []
    _add_fill(scene, specimen, joints, layout, conditions)
    _set_moving(scene, specimen, joints, layout, conditions)
    bars = [bar_places_of(scene, specimen, layout)] if scene.bar else []
    conditions.elements = [*bars, ForcesAtPoints(), *quiet, *moved]
    return conditions


def _add_supports(
    scene: Scene, specimen: Specimen, joints: Joints, layout: Layout, conditions: loads.Conditions
) -> None:
    """Dofs held by supports and by the floor."""
    holds = []
    for k, support in enumerate(scene.support):
        chosen, faces = select(specimen, joints, support.on, f"support.{k}.on")
        axes = tuple(AXES[f] for f in support.fix if f in AXES)
        holds.append(Hold(chosen, axes, _rotations(support.fix), faces, f"support.{k}"))
    if scene.floor is not None:
        holds.append(Hold(specimen.sets[FLOOR], (0, 1, 2), (0, 1, 2), None, FLOOR))
    for hold in holds:
        conditions.held_by[hold.name] = held_dofs(specimen.blocks, layout, hold)
        _add(conditions.supported, conditions.held_by[hold.name])
    _add(conditions.prescribed, conditions.supported)


def _moved_supports(scene: Scene, conditions: loads.Conditions) -> list[MovedDofs]:
    """Which dofs of supports and floor move with the ground, and with which of its components."""
    moved: dict[str, list[np.ndarray]] = {kind: [] for kind in KINDS}
    taken = {kind: np.zeros_like(mask) for kind, mask in conditions.prescribed.items()}
    selectors = {f"support.{k}": support.on for k, support in enumerate(scene.support)}
    components = 0
    for ground in scene.moved_grounds:
        own = [masks for name, masks in conditions.held_by.items() if ground.on in (None, selectors.get(name, name))]
        for axis in ground.components:
            for kind in KINDS:
                dofs = np.zeros_like(taken[kind])
                for masks in own:
                    dofs[:, AXES[axis]] |= masks[kind][:, AXES[axis]]
                if (dofs & taken[kind]).any():
                    raise SceneError(f"ground.on = '{ground.on}': another ground moves some of what this support holds")
                taken[kind] |= dofs
                moved[kind].append(np.column_stack([*np.nonzero(dofs), np.full(dofs.sum(), components)]))
            components += 1
    dofs_of = {kind: rows for kind, each in moved.items() if each and len(rows := np.concatenate(each))}
    return [MovedDofs(dofs_of, components)] if components else []


def _add_drive(drive: Drive, specimen: Specimen, joints: Joints, layout: Layout, conditions: loads.Conditions) -> None:
    """Dofs that the drive moves, and those that supports hold against it."""
    chosen, faces = select(specimen, joints, drive.on, "drive.on")
    hold = Hold(chosen, (drive.axis,), (), faces, "drive")
    driven = conditions.held_by["drive"] = held_dofs(specimen.blocks, layout, hold)
    conditions.driven = loads.drive_dofs(driven, drive.axis)
    if any((driven[kind] & conditions.supported[kind])[:, drive.axis].any() for kind in KINDS):
        raise SceneError(f"drive.on = '{drive.on}': a support holds it in the direction of the drive")
    conditions.support = loads.drive_dofs(conditions.supported, drive.axis)
    _add(conditions.prescribed, driven)


def _add_weight(
    scene: Scene, specimen: Specimen, layout: Layout, conditions: loads.Conditions, density: np.ndarray
) -> None:
    """The weight of the blocks, in parts where gravity varies or turns."""
    if scene.gravity is None:
        return
    density = _density_that_weighs(scene, specimen, density)
    for name, (acceleration, path) in scene.gravity.parts.items():
        weight: loads.Load = dict.fromkeys(KINDS)
        loads.add_gravity(layout, weight, density, acceleration)
        _add_load(layout, conditions, name, weight, varies=path is not None)


def _density_that_weighs(scene: Scene, specimen: Specimen, density: np.ndarray) -> np.ndarray:
    """(B,) kg/m3; a floor is where a specimen falls, and weighs nothing: its reaction is what it bears."""
    if scene.floor is None:
        return density
    density = density.copy()
    density[specimen.sets[FLOOR]] = 0.0
    return density


def _add_inertia(
    scene: Scene, specimen: Specimen, layout: Layout, conditions: loads.Conditions, density: np.ndarray
) -> None:
    """In the frame of the ground, forces of inertia along each axis on which it moves: their factors are its
    accelerations (m/s2)."""
    if scene.shaken is None:
        return
    density = _density_that_weighs(scene, specimen, density)
    for axis in scene.shaken.components:
        inertia: loads.Load = dict.fromkeys(KINDS)
        loads.add_gravity(layout, inertia, density, -np.eye(3)[AXES[axis]])
        _add_load(layout, conditions, f"ground {axis}", inertia, varies=True)


def _quiet_faces(
    scene: Scene, specimen: Specimen, joints: Joints, layout: Layout, conditions: loads.Conditions
) -> Drag:
    """Dashpots on faces, and the stress of waves along each of their axes: their factors are velocities (m/s)."""
    drag = Drag()
    owner = np.full(specimen.blocks.face_block().size, -1)
    for k, quiet in enumerate(scene.quiet):
        where = f"quiet.{k}.on"
        chosen, faces = select(specimen, joints, quiet.on, where)
        if faces is None:
            example = example_of(specimen, joints, quiet.on)
            raise SceneError(f"{where} = '{quiet.on}': waves leave through faces{example}")
        if not layout.deforms[chosen].all():
            raise SceneError(
                f"{where} = '{quiet.on}': rigid blocks have no waves; give them kinematics 'tets' or 'affine'"
            )
        if (twice := owner[faces].max(initial=-1)) >= 0:
            raise SceneError(
                f"{where} = '{quiet.on}': quiet.{twice} has some of these faces already, and dashpots would act twice; "
                "keep one of them, or name other faces"
            )
        owner[faces] = k
        push = {kind: np.zeros((layout.rows(kind), DOFS[kind], 3)) for kind in KINDS}
        for face in faces.tolist():
            block = int(specimen.blocks.face_block()[face])
            group = specimen.blocks.groups[specimen.blocks.group[block]]
            add_face(drag, push, specimen.blocks, layout, face, impedance_of(scene, quiet, group))
        for axis in () if quiet.wave is None else quiet.wave.components:
            wave: loads.Load = {kind: rows[:, :, AXES[axis]] if len(rows) else None for kind, rows in push.items()}
            _add_load(layout, conditions, f"quiet.{k} {axis}", wave, varies=True)
    return drag


def impedance_of(scene: Scene, quiet: QuietBoundary, group: str) -> tuple[float, float]:
    """Rho c_p and rho c_s, Pa s/m, of what goes on behind the face of a block of a group."""
    of = scene.material[group]
    lame, mu = Material(of.density, of.young_modulus, of.poisson_ratio).lame()
    density = of.density if quiet.density is None else quiet.density
    p_speed, s_speed = float(np.sqrt((lame + 2.0 * mu) / of.density)), float(np.sqrt(mu / of.density))
    return density * (quiet.p_speed or p_speed), density * (quiet.s_speed or s_speed)


def _add_load(layout: Layout, conditions: loads.Conditions, name: str, load: loads.Load, varies: bool) -> None:
    """A load, among those that vary or those that do not."""
    conditions.each_load[name] = load
    if varies:
        conditions.varying.append(load)
    else:
        loads.add_load(layout, conditions.load, load)


def _add_fill(scene: Scene, specimen: Specimen, joints: Joints, layout: Layout, conditions: loads.Conditions) -> None:
    """The weight of earth on blocks."""
    for k, fill in enumerate(scene.fill):
        chosen, gravity = select(specimen, joints, fill.on, f"fill.{k}.on")[0], scene.gravity
        if layout.meshed[chosen].any():
            raise SceneError(f"fill.{k}.on = '{fill.on}': a fill acts on rigid and affine blocks, not on tets")
        columns = columns_of(fill, f"fill.{k}", specimen, joints, chosen)
        load = weight_of(columns, layout, fill.density * (-gravity.z if gravity else 0.0))
        _add_load(layout, conditions, f"fill.{k}", load, varies=False)


def _set_moving(scene: Scene, specimen: Specimen, joints: Joints, layout: Layout, conditions: loads.Conditions) -> None:
    """The velocities and spins with which blocks start; those that several entries name move by the sum."""
    if not scene.motion:
        return
    motion = {kind: np.zeros((layout.rows(kind), DOFS[kind])) for kind in KINDS}
    spin = np.zeros((specimen.blocks.count, 3))
    for k, start in enumerate(scene.motion):
        where = f"motion.{k}.on"
        chosen, faces = select(specimen, joints, start.on, where)
        if faces is not None:
            raise SceneError(f"{where} = '{start.on}': whole blocks start in motion; name a set, without a face")
        volume = layout.volume[chosen]
        centre = np.average(layout.centroid[chosen], axis=0, weights=volume) if start.about is None else start.about
        angular_velocity = np.array(start.spin)
        spin[chosen] += angular_velocity
        for kind in KINDS:
            if len(rows := KIND[kind].rows_of(layout, chosen)) == 0:
                continue
            moves = velocities_of(layout, kind, rows, np.array(start.velocity), angular_velocity, np.array(centre))
            if (moves[conditions.prescribed[kind][rows]] != 0.0).any():
                raise SceneError(f"{where} = '{start.on}': a support or the drive holds what this sets in motion")
            motion[kind][rows] += moves
    conditions.motion, conditions.spin = motion, spin


def _rotations(fix: tuple[str, ...]) -> tuple[int, ...]:
    """The axes that blocks may not turn about."""
    return tuple(k for axis, k in AXES.items() if "rotation" in fix or f"rotation {axis}" in fix)


def _add(masks: dict[str, np.ndarray], more: dict[str, np.ndarray]) -> None:
    """Dofs that are held besides those that already are."""
    for kind in KINDS:
        masks[kind] |= more[kind]


def select(specimen: Specimen, joints: Joints, word: str, where: str) -> tuple[np.ndarray, np.ndarray | None]:
    """Blocks of a selector, and its faces if it names some: "top", "top.z+", "z = 0 mm", "blocks at z = 0 mm"; of
    several together, "left + right", those of each."""
    name, face = word, None
    if word not in specimen.sets and ALSO in word:
        return _each_of([select(specimen, joints, part, where) for part in word.split(ALSO)], f"{where} = '{word}'")
    if word not in specimen.sets and (plane := PLANE.fullmatch(word)):
        return _in_plane(specimen, joints, plane, f"{where} = '{word}'")
    if word not in specimen.sets and word[-1:] in "+-" and "." in word:
        name, _, face = word.rpartition(".")
    if name not in specimen.sets:
        faces_too = "" if where.split(".")[0] in WHOLE_BLOCKS else free_face(specimen, joints, specimen.sets)
        faces_too = faces_too and f", or a face of one, such as '{faces_too}'"
        raise SceneError(f"{where} = '{word}' selects nothing; {nearest(name, specimen.sets)}{faces_too}")
    chosen = specimen.sets[name]
    if face is None:
        return chosen, None
    try:
        return chosen, boundary.outer_faces(specimen.blocks, joints, chosen, face)
    except GeometryError as error:
        raise SceneError(f"{where} = '{word}': {error}") from None


def free_face(specimen: Specimen, joints: Joints, names: Iterable[str]) -> str:
    """A selector of an outer face of one of some sets, the first by name that has one; "" where none has."""
    for name in sorted(names):
        for direction in SHOWN:
            with suppress(GeometryError):
                boundary.outer_faces(specimen.blocks, joints, specimen.sets[name], direction)
                return f"{name}.{direction}"
    return ""


def example_of(specimen: Specimen, joints: Joints, name: str) -> str:
    """The end of a message that asks for a face of a set: one that there is."""
    face = free_face(specimen, joints, [name] if name in specimen.sets else specimen.sets)
    return f", for example '{face}'" if face else ""


def _each_of(parts: list[tuple[np.ndarray, np.ndarray | None]], where: str) -> tuple[np.ndarray, np.ndarray | None]:
    """Union of the choices of several selectors, each block and each face once."""
    faces = [part for _, part in parts if part is not None]
    if faces and len(faces) < len(parts):
        raise SceneError(f"{where}: names whole blocks and faces; name sets only, or a face of each")
    chosen = np.unique(np.concatenate([blocks for blocks, _ in parts]))
    return chosen, np.unique(np.concatenate(faces)) if faces else None


def _in_plane(
    specimen: Specimen, joints: Joints, plane: re.Match[str], where: str
) -> tuple[np.ndarray, np.ndarray | None]:
    """Outer faces in a plane and their blocks; or all blocks with a face in it."""
    blocks_only, axis, level = plane[1] is not None, AXES[plane[2]], parse(plane[3], "length", where)
    try:
        if blocks_only:
            return np.unique(specimen.blocks.face_block()[boundary.faces_in_plane(specimen.blocks, axis, level)]), None
        faces = boundary.free_faces_in_plane(specimen.blocks, joints, axis, level)
    except GeometryError as error:
        raise SceneError(f"{where}: {error}") from None
    return np.unique(specimen.blocks.face_block()[faces]), faces
