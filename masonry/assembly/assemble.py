"""From a scene to a model: specimen, joints, mesh, laws, conditions, and the program of loading."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen, TetMesh
from geometry.joints.find import find_joints, stated_joints
from geometry.joints.point_density import Density
from geometry.meshes.fan_tets import within
from geometry.polyhedra import overlaps
from geometry.polyhedra.construct import with_own_points
from geometry.specimens.numbered import mesh_by_place
from geometry.specimens.placed import with_empty_blocks
from masonry.assembly.conditions import conditions_of
from masonry.assembly.contact_pairs import Pairs, meetings_of, pairs_of
from masonry.assembly.gauge_places import gauges_of
from masonry.assembly.growing_loads import let_grow, require_places
from masonry.assembly.layers import lay_in_layers
from masonry.assembly.loose_parts import require_held
from masonry.assembly.masses import density_of, moving_density_of
from masonry.assembly.scattered_laws import Drawn, draw, laws_of
from masonry.assembly.schedule import plan_of, uniform_ground
from masonry.assembly.size_limits import require_sane_size
from masonry.assembly.specimens import as_turned, specimen_of
from masonry.configuration.setting_off import begin
from masonry.errors import SceneError, nearest
from masonry.ground.uniform_ground import UniformGround
from masonry.laws.building import factory
from masonry.loading.plan import Plan
from masonry.model import model
from masonry.model.contact_groups import contact_group_name
from masonry.model.damping import damping_of, swing_of
from masonry.model.gauges import Gauge
from masonry.model.large.meeting import Meetings
from masonry.model.layout import Layout, Material, lay_out
from masonry.model.loads import Conditions
from masonry.monitors.reactions import Surroundings
from masonry.monitors.recording import Recording
from masonry.scene import Scene


@dataclass(frozen=True)
class Assembly:
    """All that a run needs, built from a scene; `joints` in the order of the model's contacts; `pairs` in large
    displacement only: what serves blocks that meet, whatever their groups."""

    scene: Scene
    specimen: Specimen
    joints: Joints
    mesh: TetMesh | None
    model: model.Model
    plan: Plan
    recording: Recording
    drawn: list[Drawn]
    pairs: Pairs | None = None


class Fabric(NamedTuple):
    """Blocks and joints of a scene, before anything loads them.

    joints          sorted by contact group      contact_groups, group  their names, and (C,) the number of each contact
    density         (B,) kg/m3 of what weighs    moving_density  (B,) of what moves with the blocks
    """

    specimen: Specimen
    joints: Joints
    mesh: TetMesh | None
    contact_groups: tuple[str, ...]
    group: np.ndarray
    materials: dict[str, Material]
    layout: Layout
    density: np.ndarray
    moving_density: np.ndarray


def fabric_of(scene: Scene) -> Fabric:
    """Raises SceneError or GeometryError with one clear message."""
    specimen, joints = joined(scene)
    require_groups(scene, specimen.blocks.groups)
    require_contact_groups(scene, specimen, joints)
    mesh, joints = meshed(scene, specimen.blocks, joints)
    if scene.is_large:  # cells of a unit share corners, and each goes its own way
        specimen = replace(specimen, blocks=with_own_points(specimen.blocks))
    blocks = specimen.blocks
    names, group, joints = model.sort_by_group(blocks, joints)
    materials = {g: material_of(scene, g) for g in blocks.groups}
    layout = lay_out(blocks, {g: scene.kinematics_of(g) for g in blocks.groups}, mesh)
    density = density_of(scene, specimen, joints, materials)
    moving_density = moving_density_of(scene, specimen, joints, density)
    return Fabric(specimen, joints, mesh, names, group, materials, layout, density, moving_density)


def assemble(scene: Scene) -> Assembly:
    """Build the model of a scene; raises SceneError or GeometryError with one clear message."""
    fabric = fabric_of(scene)
    specimen, joints, layout, density = fabric.specimen, fabric.joints, fabric.layout, fabric.density
    blocks, mesh, names = specimen.blocks, fabric.mesh, fabric.contact_groups
    compressions = sorted({0.0, scene.confinement or 0.0})
    pairs = pairs_of(scene, blocks, compressions) if scene.is_large else None
    moving_density = fabric.moving_density if scene.solver.masses == "real" else density
    conditions = _all_conditions(scene, specimen, joints, layout, density, moving_density)
    drawn = _draws(scene, blocks, joints, names, fabric.group)
    laws = _laws(scene, names, drawn, compressions)
    meetings = None if pairs is None else meetings_of(pairs, scene)
    stepping = _stepping(scene, mesh, meetings)
    built = model.build(blocks, joints, fabric.materials, laws, stepping, conditions, layout, meetings, moving_density)
    plan = plan_of(scene, built.dt)
    if plan.moves_at_once:
        first = plan.factors_at(np.zeros(1))
        begin(built, None if first is None else first[:, 0], scene.has_dead_loads)
    gauges, ground = gauges_of(scene, specimen, joints, layout), uniform_ground(scene, built.dt)
    recording = _recording(scene, specimen, gauges, Surroundings(conditions), ground)
    return Assembly(scene, specimen, joints, mesh, built, plan, recording, drawn, pairs)


def _all_conditions(
    scene: Scene,
    specimen: Specimen,
    joints: Joints,
    layout: Layout,
    density: np.ndarray,
    moving_density: np.ndarray,
) -> Conditions:
    """Supports and loads, the one that grows among them. Raises SceneError where something stands on nothing."""
    conditions = conditions_of(scene, specimen, layout, joints, density, moving_density)
    require_places(scene, specimen, joints)
    if scene.grows:
        let_grow(scene, specimen, joints, layout, density, conditions)
    if scene.must_stand:
        require_held(specimen, joints, layout, conditions, loaded=bool(scene.traction) or scene.gravity is not None)
        for varying in conditions.varying:
            require_held(specimen, joints, layout, replace(conditions, load=varying), loaded=True)
    if scene.comes_in_layers:
        lay_in_layers(scene, specimen.blocks, layout, density, conditions)
    return conditions


def _laws(scene: Scene, names: tuple[str, ...], drawn: list[Drawn], compressions: list[float]) -> dict[str, tuple]:
    """By contact group, its parameters and joint properties; those that are drawn differ from contact to contact."""
    properties = {name: scene.contact_of(name).properties(scene.turns_back) for name in names}
    laws = {name: factory.build(name, properties[name], compressions) for name in names}
    return laws | {d.group: laws_of(d, properties[d.group], compressions) for d in drawn}


def _stepping(scene: Scene, mesh: TetMesh | None, meetings: Meetings | None) -> model.Stepping:
    """How time advances. Raises SceneError where the time step would not be proven."""
    solver = scene.solver
    if solver.masses == "scaled" and solver.time_step == "equation-11":
        raise SceneError(
            'solver.time_step = "equation-11" needs solver.masses = "real": scaled masses have one bound of their own'
        )
    if solver.masses == "scaled" and mesh is not None and meetings is not None and meetings.rules.dashpot.any():
        raise SceneError(
            "normal_dashpot of blocks of kinematics 'tets' needs solver.masses = \"real\": the time step is not proven "
            "for it with scaled masses, where solver.damping does the same"
        )
    damping = damping_of(solver, scene.is_controlled)
    if not scene.swings:
        return model.Stepping(solver.masses, solver.time_step, solver.step_fraction, damping)
    damping = damping if scene.settles else None
    return model.Stepping(solver.masses, solver.time_step, solver.step_fraction, damping, swing_of(scene.damping))


def _recording(
    scene: Scene,
    specimen: Specimen,
    gauges: tuple[Gauge, ...],
    surroundings: Surroundings,
    ground: UniformGround | None,
) -> Recording:
    """Quantities recorded of a run."""
    drive, solver = scene.drive, scene.solver
    weight = (0.0, 0.0, 0.0) if scene.gravity is None else scene.gravity.vector
    return Recording(
        section=specimen.section,
        sign=1.0 if drive is None else drive.sign,
        rows=solver.rows,
        rotation_limit=solver.rotation_limit,
        gauges=gauges,
        frames=solver.frames,
        slip_limit=solver.slip_limit,
        sets=specimen.sets,
        surroundings=surroundings,
        axis=None if drive is None else drive.axis,
        ground=ground,
        weight_when_shaken=weight if scene.ground else None,
    )


def joined(scene: Scene) -> tuple[Specimen, Joints]:
    """The blocks of a scene and the joints between them."""
    require_sane_size(scene)
    specimen, spec = specimen_of(scene), scene.specimen
    points = scene.contact_points, scene.points_per_edge or 2, spec.points_per_face, spec.contact_spacing
    if specimen.joints is not None:  # overlaps were looked at as these were laid
        return specimen, stated_joints(specimen.joints, Density(*points))
    if spec.made_elsewhere:  # the others were looked at as they were built
        overlaps.check_overlaps(specimen.blocks, allowed=specimen.overlap)
    return specimen, find_joints(specimen.blocks, *points)


def meshed(scene: Scene, blocks: Blocks, joints: Joints) -> tuple[TetMesh | None, Joints]:
    """Tets in the blocks that a scene wants to have them, those of its file first, and the joints with points there."""
    wanted = np.array([scene.is_meshed(g) for g in blocks.groups])[blocks.group]
    if not wanted.any():
        return None, joints
    spec = scene.specimen
    if (brought := spec.own_mesh) is not None:
        from geometry.meshes.nonmatching import surface_joints

        own = mesh_by_place(*brought) if scene.is_large else brought[0]
        own = with_empty_blocks(replace(own, nodes=as_turned(scene, own.nodes)), blocks)
        mesh = within(own, wanted)
        if np.all(wanted == (np.diff(mesh.tet_start) > 0)):
            return mesh, surface_joints(blocks, joints, mesh)
    if scene.specimen.mesh == "fan":
        from geometry.meshes.fan import mesh_by_fans

        return mesh_by_fans(blocks, wanted, joints)
    from geometry.meshes.tetrahedralise import mesh_blocks

    if scene.specimen.mesh_size is None:
        raise SceneError(
            "specimen.mesh_size: missing; kinematics 'tets' needs it where the file holds no tets of its own: "
            "mesh_size = '25 mm', or mesh = 'fan'"
        )
    return mesh_blocks(blocks, wanted, scene.specimen.mesh_size, joints)


def _draws(scene: Scene, blocks: Blocks, joints: Joints, names: tuple[str, ...], group: np.ndarray) -> list[Drawn]:
    """Values drawn by the scene's scatter, group by group; joints sorted by group (C,)."""
    if scene.scatter is None:
        return []
    bounds = np.searchsorted(group, np.arange(len(names) + 1))
    return [
        draw(scene.scatter, scene.contact, name, blocks, joints, slice(bounds[g], bounds[g + 1]))
        for g, name in enumerate(names)
        if name in scene.scatter.groups
    ]


def material_of(scene: Scene, group: str) -> Material:
    """Of a group of blocks; a floor that has no table weighs what the densest group does: it does not move."""
    if group not in scene.material:
        return Material(max(material.density for material in scene.material.values()))
    of = scene.material[group]
    return Material(of.density, of.young_modulus, of.poisson_ratio)


def require_groups(scene: Scene, groups: tuple[str, ...]) -> None:
    """Every group of blocks has a material; every table names a group that there is. Raises SceneError."""
    for group in groups:
        if group not in scene.material and not scene.is_floor(group):
            raise SceneError(f"[material.{group}] is missing: the specimen has blocks of group '{group}'")
    for group in scene.material:
        if group not in groups:
            raise SceneError(f"[material.{group}]: the specimen has no blocks of this group; {nearest(group, groups)}")
    for group in scene.kinematics:
        if group != "default" and group not in groups:
            raise SceneError(f"kinematics.{group}: the specimen has no blocks of this group; {nearest(group, groups)}")


def require_contact_groups(scene: Scene, specimen: Specimen, joints: Joints) -> None:
    """Every group that occurs has a table; every table names a group that this specimen can have."""
    occurring = model.contact_groups(specimen.blocks, joints)[0]
    for name in occurring:
        if name not in scene.contact and not scene.is_large:  # there pairs_of asks for all that may come to meet
            raise SceneError(
                f"[contact.{name}] is missing: the specimen has such contacts; {nearest(name, scene.contact)}"
            )
    groups = specimen.blocks.groups
    possible = {contact_group_name(g, h, same) for g in groups for h in groups for same in (True, False)}
    for name in scene.contact:
        if name not in possible and name != "default":
            raise SceneError(f"[contact.{name}]: no such contacts in this specimen; {nearest(name, possible)}")
