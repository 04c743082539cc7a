"""From a scene to a model: specimen, joints, mesh, laws, conditions, and the program of loading."""

import difflib
from dataclasses import dataclass

import numpy as np

from geometry import boundary, overlaps
from geometry import joints as joint_search
from geometry.blocks import GeometryError, Joints, Specimen, TetMesh
from geometry.boxes import boxes
from geometry.couplet import couplet
from geometry.wallette import wallette
from masonry import loads, model
from masonry.bodies import KINDS, Layout, Material, lay_out
from masonry.contact_groups import contact_group_name
from masonry.errors import SceneError
from masonry.laws import build as law_build
from masonry.scene import Scene
from masonry.timeloop import Recording

AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True)
class Assembly:
    """All that a run needs, built from a scene; `joints` in the order of the model's contacts."""

    scene: Scene
    specimen: Specimen
    joints: Joints
    mesh: TetMesh | None
    model: model.Model
    program: loads.Program
    recording: Recording


def assemble(scene: Scene) -> Assembly:
    """Build the model of a scene; raises SceneError or GeometryError with one clear message."""
    specimen = specimen_of(scene)
    blocks = specimen.blocks
    overlaps.check_overlaps(blocks)
    _require_groups(scene, blocks.groups)
    kinds = {g: scene.kinematics_of(g) for g in blocks.groups}
    joints = joint_search.find_joints(blocks, scene.specimen.contact_points, scene.specimen.points_per_edge)
    _require_contact_groups(scene, specimen, joints)
    mesh = None
    if "tets" in kinds.values():
        from geometry.mesher import mesh_blocks

        assert scene.specimen.mesh_size is not None
        meshed = np.array([kinds[g] == "tets" for g in blocks.groups])[blocks.group]
        mesh, joints = mesh_blocks(blocks, meshed, scene.specimen.mesh_size, joints)
    names, _, joints = model.sort_by_group(blocks, joints)
    materials = {
        g: Material(m.density, m.young_modulus, m.poisson_ratio)
        for g, m in scene.material.items()
        if g in blocks.groups
    }
    layout = lay_out(blocks, kinds, mesh)
    conditions = conditions_of(scene, specimen, layout, joints, materials)
    _require_held(specimen, joints, layout, conditions)
    compressions = sorted({0.0, scene.confinement or 0.0})
    laws = {name: law_build.build(name, _properties(scene.contact[name]), compressions) for name in names}
    s = scene.solver
    stepping = model.Stepping(s.masses, s.time_step, s.step_fraction, s.damping)
    if s.time_step == "equation-11" and s.masses == "scaled":
        raise SceneError(
            'solver.time_step = "equation-11" needs solver.masses = "real": scaled masses have one bound of their own'
        )
    built = model.build(blocks, joints, materials, laws, stepping, conditions, layout)
    program = _program(scene, built.dt)
    sign = scene.drive.sign if scene.drive else 1.0
    recording = Recording(specimen.section, sign, s.rows, s.rotation_limit)
    return Assembly(scene, specimen, joints, mesh, built, program, recording)


def specimen_of(scene: Scene) -> Specimen:
    """The blocks of a scene, with named sets."""
    spec = scene.specimen
    if spec.kind == "couplet":
        mortar = (spec.mortar.thickness, spec.mortar.divisions) if spec.mortar else None
        return couplet(spec.length, spec.width, spec.height, spec.divisions, mortar, spec.plates)
    if spec.kind == "wallette":
        return wallette(
            spec.courses,
            spec.units_per_course,
            spec.unit_length,
            spec.unit_height,
            spec.thickness,
            spec.joint_thickness,
            spec.divisions,
            spec.plates,
        )
    return boxes([(b.name, b.origin, b.size, b.group, b.unit, b.divisions) for b in spec.box], spec.section)


def _properties(contact) -> dict:
    keys = (
        *("law", "normal_stiffness", "shear_stiffness", "tensile_strength", "cohesion", "tan_friction"),
        *("residual_cohesion", "tan_residual_friction", "fracture_energy_mode_1", "fracture_energy_mode_2"),
        *("fracture_energy_mode_2_slope", "exponent_tension", "exponent_shear", "dilation_angle", "dilation_cutoff"),
        *("unloading", "softening_variable", "coupling"),
    )
    return {key: getattr(contact, key) for key in keys}


def _nearest(word: str, known) -> str:
    close = difflib.get_close_matches(word, list(known), 1, 0.4)
    hint = f"; did you mean '{close[0]}'?" if close else ""
    return f"known here: {', '.join(sorted(known))}{hint}"


def _require_groups(scene: Scene, groups: tuple[str, ...]) -> None:
    for group in groups:
        if group not in scene.material:
            raise SceneError(f"[material.{group}] is missing: the specimen has blocks of group '{group}'")
    for group in scene.material:
        if group not in groups:
            raise SceneError(f"[material.{group}]: the specimen has no blocks of this group; {_nearest(group, groups)}")
    for group in scene.kinematics:
        if group != "default" and group not in groups:
            raise SceneError(f"kinematics.{group}: the specimen has no blocks of this group; {_nearest(group, groups)}")


def _require_contact_groups(scene: Scene, specimen: Specimen, joints: Joints) -> None:
    """Every group that occurs has a table; every table names a group that this specimen can have."""
    occurring = model.contact_groups(specimen.blocks, joints)[0]
    for name in occurring:
        if name not in scene.contact:
            raise SceneError(
                f"[contact.{name}] is missing: the specimen has such contacts; {_nearest(name, scene.contact)}"
            )
    groups = specimen.blocks.groups
    possible = {contact_group_name(g, h, same) for g in groups for h in groups for same in (True, False)}
    for name in scene.contact:
        if name not in possible:
            raise SceneError(f"[contact.{name}]: no such contacts in this specimen; {_nearest(name, possible)}")


def conditions_of(
    scene: Scene, specimen: Specimen, layout: Layout, joints: Joints, materials: dict[str, Material]
) -> loads.Conditions:
    """Supports, drive and dead loads on the freedoms."""
    blocks, conditions = specimen.blocks, loads.no_conditions(layout)
    supports: list[dict[str, np.ndarray]] = []
    for k, support in enumerate(scene.support):
        where = f"support.{k}.on"
        chosen, faces = select(specimen, joints, support.on, where)
        axes = tuple(AXES[f] for f in support.fix if f in AXES)
        hold = loads.Hold(chosen, axes, "rotation" in support.fix, faces, f"support.{k}")
        supports.append(loads.held_freedoms(blocks, layout, hold))
    driven = None
    if scene.drive is not None:
        chosen, faces = select(specimen, joints, scene.drive.on, "drive.on")
        hold = loads.Hold(chosen, (scene.drive.axis,), False, faces, "drive")
        driven = loads.held_freedoms(blocks, layout, hold)
        conditions.driven = loads.drive_freedoms(driven, scene.drive.axis)
        nothing = loads.no_conditions(layout).prescribed
        held = {kind: np.any([nothing[kind], *(s[kind] for s in supports)], axis=0) for kind in KINDS}
        if any((driven[kind] & held[kind]).any() for kind in KINDS):
            raise SceneError(f"drive.on = '{scene.drive.on}': a support holds it in the direction of the drive")
        conditions.support = loads.drive_freedoms(held, scene.drive.axis)
    for mask in [*supports, *([driven] if driven else [])]:
        for kind in KINDS:
            conditions.prescribed[kind] |= mask[kind]
    for k, traction in enumerate(scene.traction):
        where = f"traction.{k}.on"
        _, faces = select(specimen, joints, traction.on, where)
        if faces is None:
            raise SceneError(f"{where} = '{traction.on}': a traction acts on a face, for example '{traction.on}.z+'")
        loads.add_traction(blocks, layout, conditions.load, loads.Push(faces, np.array(traction.stress)))
    if scene.gravity is not None:
        density = np.array([materials[g].density for g in blocks.groups])[blocks.group]
        loads.add_gravity(layout, conditions.load, density, np.array(scene.gravity))
    return conditions


def select(specimen: Specimen, joints: Joints, word: str, where: str) -> tuple[np.ndarray, np.ndarray | None]:
    """Blocks of a selector, and its faces if it names one: "top", "top.z+"."""
    name, face = word, None
    if word not in specimen.sets and word[-1:] in "+-" and "." in word:
        name, _, face = word.rpartition(".")
    if name not in specimen.sets:
        raise SceneError(
            f"{where} = '{word}' selects nothing; {_nearest(name, specimen.sets)}, or a face of one: '{name}.z+'"
        )
    chosen = specimen.sets[name]
    if face is None:
        return chosen, None
    try:
        return chosen, boundary.outer_faces(specimen.blocks, joints, chosen, face)
    except GeometryError as error:
        raise SceneError(f"{where} = '{word}': {error}") from None


def _require_held(specimen: Specimen, joints: Joints, layout: Layout, conditions: loads.Conditions) -> None:
    """Every connected part of the specimen must be held somewhere, or it would drift."""
    part = joint_search.connected(specimen.blocks, joints)
    held = np.zeros(specimen.blocks.count, dtype=bool)
    for kind in ("rigid", "affine"):
        held[layout.members[kind]] = conditions.prescribed[kind].any(axis=1)
    if layout.mesh is not None:
        node_held: np.ndarray = np.any(conditions.prescribed["tets"], axis=1, keepdims=True)
        for b in layout.members["tets"]:
            held[b] = node_held[layout.mesh.node_start[b] : layout.mesh.node_start[b + 1]].any()
    loose = np.setdiff1d(part, part[held])
    if len(loose):
        block = int(np.flatnonzero(part == loose[0])[0])
        where = ", ".join(f"{x:.4g}" for x in layout.centroid[block])
        raise SceneError(
            f"block {block} (group '{specimen.blocks.groups[specimen.blocks.group[block]]}', unit "
            f"{specimen.blocks.unit[block]}) at ({where}) m and what it touches are held by nothing; "
            "add a [[support]], or close the gap to its neighbours"
        )


def _program(scene: Scene, dt: float) -> loads.Program:
    settle = scene.settle.steps if scene.settle else 0
    if scene.drive is None:
        return loads.program(dt, settle, 0.0, None, None, 0.0)
    d = scene.drive
    return loads.program(dt, settle, d.sign * d.displacement, d.steps, d.rate, d.ramp)
