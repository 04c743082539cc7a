"""The load of [limit] on the dofs of the bodies at a factor of 1: for limit analysis, and for runs in which it
grows."""

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.polyhedra.intersect import holds
from masonry.assembly.conditions import example_of, select
from masonry.assembly.road.axle_pressure import Pressure, RoadBed, load_of, road_bed
from masonry.errors import SceneError
from masonry.model.layout import KINDS, Layout
from masonry.model.loads import Conditions, Load, PointForce, Push, add_force, add_gravity, add_traction, points_of
from masonry.scene import Scene
from masonry.scene.tables.limit import LEFT_OUT, LimitLoad

EDGE = 1e-6
"""Share of the size of the specimen by which a place may lie outside of a block that holds it."""
VEHICLE_CURE = (
    "give limit.accuracy = '1 %' and vehicle.position, such as '1.3 m' (`masonry limit` finds the worst one); for the "
    "other loads alone give limit.accuracy = 'none'"
)
"""What a run of a vehicle needs."""


def require_axles_to_load(scene: Scene) -> None:
    """Raises SceneError for a vehicle that a run would leave out."""
    limit = scene.limit
    if scene.vehicle is not None and not scene.grows and (limit is None or limit.accuracy != LEFT_OUT):
        why = "without it a run leaves out the axles of the vehicle"
        raise SceneError(f"limit.accuracy: missing; {why}; {VEHICLE_CURE}")


def let_grow(
    scene: Scene, specimen: Specimen, joints: Joints, layout: Layout, density: np.ndarray, into: Conditions
) -> None:
    """Add the load of [limit] to those that vary: one, or for a tilt two, see loading/collapse/factor_path.py."""
    limit = scene.limit
    assert limit is not None
    gravity = gravity_of(scene)
    if limit.pattern == "vehicle":
        pressure = pressure_of(scene, specimen, joints, layout)
        loads, points = {"limit": load_of(pressure, layout)}, _points_below(pressure, layout)
    else:
        loads = {"limit": growing_load(specimen, joints, layout, limit, density, gravity)}
        points = _points_of(specimen, joints, layout, limit)
    into.at_points["limit"] = points
    if limit.pattern == "tilt":
        turning: Load = dict.fromkeys(KINDS)
        add_gravity(layout, turning, density, np.where(np.arange(3) == _axis(limit.about), 0.0, gravity))
        loads = {"limit cos": turning, "limit sin": loads["limit"]}
    acting = [load[~into.prescribed[k]] for one in loads.values() for k, load in one.items() if load is not None]
    if not any(load.any() for load in acting):
        raise SceneError(f"nothing loads this: {limit.pattern} of [limit] acts on no block that can move")
    into.each_load |= loads
    into.varying += loads.values()


def require_places(scene: Scene, specimen: Specimen, joints: Joints) -> None:
    """Check of the places in [limit] and [vehicle], also if only `masonry limit` uses them. Raises SceneError."""
    for word, where in (
        (None if scene.limit is None else scene.limit.on, "limit.on"),
        (None if scene.vehicle is None else scene.vehicle.on, "vehicle.on"),
    ):
        if word is not None:
            select(specimen, joints, word, where)


def bed_of(scene: Scene, specimen: Specimen, joints: Joints) -> RoadBed:
    """Of the road below the vehicle of a scene. Raises SceneError."""
    vehicle = scene.vehicle
    assert vehicle is not None
    chosen, faces = select(specimen, joints, vehicle.on, "vehicle.on")
    if faces is not None:
        raise SceneError(f"vehicle.on = '{vehicle.on}': a road lies on whole blocks; name a set, without a face")
    return road_bed(vehicle, specimen, joints, chosen)


def pressure_of(scene: Scene, specimen: Specimen, joints: Joints, layout: Layout) -> Pressure:
    """Of the vehicle of a scene, where that says it stands. Raises SceneError."""
    vehicle = scene.vehicle
    assert vehicle is not None and vehicle.position is not None
    pressure = bed_of(scene, specimen, joints).pressure(vehicle, vehicle.position, vehicle.directions[0])
    if layout.meshed[pressure.owner].any():
        raise SceneError(f"vehicle.on = '{vehicle.on}': axles press on rigid and affine blocks, not on tets")
    return pressure


def _points_below(pressure: Pressure, layout: Layout) -> list[PointForce]:
    """Forces of a vehicle on rigid blocks, which move with these."""
    below = zip(pressure.owner.tolist(), pressure.force, pressure.centre, strict=True)
    return [
        PointForce(block, centre - layout.centroid[block], np.array([0.0, 0.0, -force]), False)
        for block, force, centre in below
        if not layout.deforms[block]
    ]


def _points_of(specimen: Specimen, joints: Joints, layout: Layout, limit: LimitLoad) -> list[PointForce]:
    """The forces at points of rigid blocks among the load that grows, at a factor of 1; none of it stays in space."""
    if limit.pattern not in ("traction", "force") or (limit.pattern == "force" and limit.at is None):
        return []
    assert limit.on is not None
    chosen, faces = select(specimen, joints, limit.on, "limit.on")
    if faces is not None:
        return points_of(specimen.blocks, layout, Push(faces, np.array(limit.stress)))
    at, share = np.array(limit.at), layout.volume / layout.volume[chosen].sum()
    rigid = [b for b in chosen.tolist() if not layout.deforms[b]]
    return [PointForce(b, at - layout.centroid[b], share[b] * np.array(limit.force), False) for b in rigid]


def gravity_of(scene: Scene) -> np.ndarray:
    """(3,) m/s2, 0 without."""
    return np.zeros(3) if scene.gravity is None else np.array(scene.gravity.vector)


def growing_load(
    specimen: Specimen, joints: Joints, layout: Layout, limit: LimitLoad, density: np.ndarray, gravity: np.ndarray
) -> Load:
    """The load by kind; the force of a drive is no load. Raises SceneError."""
    load: Load = dict.fromkeys(KINDS)
    if limit.pattern == "weight":
        towards = _sign(limit.direction) * np.linalg.norm(gravity) * np.eye(3)[_axis(limit.direction)]
        add_gravity(layout, load, density, towards)
        return load
    if limit.pattern == "tilt":
        add_gravity(layout, load, density, np.cross(_sign(limit.about) * np.eye(3)[_axis(limit.about)], gravity))
        return load
    assert limit.on is not None
    chosen, faces = select(specimen, joints, limit.on, "limit.on")
    if limit.pattern == "traction":
        if faces is None:
            example = example_of(specimen, joints, limit.on)
            raise SceneError(
                f"limit.on = '{limit.on}': a traction acts on a face{example}; a force acts on whole blocks"
            )
        add_traction(specimen.blocks, layout, load, Push(faces, np.array(limit.stress)))
        return load
    if faces is not None:
        raise SceneError(f"limit.on = '{limit.on}': a force acts on whole blocks; a traction acts on a face")
    if limit.at is not None:
        _require_in(specimen, chosen, limit.on, np.array(limit.at))
    _add_force(layout, load, chosen, np.array(limit.force), limit.at)
    return load


def _require_in(specimen: Specimen, chosen: np.ndarray, on: str, at: np.ndarray) -> None:
    """A force acts at a place of its blocks. Raises SceneError for one outside, with the block that holds it."""
    blocks = specimen.blocks
    size = float(np.ptp(blocks.points, axis=0).max())
    outside = [b for b in chosen.tolist() if not holds(blocks, b, at, EDGE * size)]
    if not outside:
        return
    where = f"limit.at = ({', '.join(f'{x:.6g}' for x in at)}) m"
    what = f"'{on}'" if len(chosen) == 1 else f"block {outside[0]} of '{on}', which bears a part of the force"
    others = [b for b in range(blocks.count) if holds(blocks, b, at, EDGE * size)]
    if not others:
        raise SceneError(f"{where} lies outside of {what}, and in no other block; give a place in it, or leave it out")
    names = [name for name, members in specimen.sets.items() if members.tolist() == [others[0]]]
    hint = f"on = '{names[0]}'" if names else "a set of this block alone"
    raise SceneError(
        f"{where} lies outside of {what}; block {others[0]} holds it: {hint}, if no support holds that one; or give "
        "another place, or leave it out"
    )


def _add_force(
    layout: Layout, load: Load, chosen: np.ndarray, force: np.ndarray, at: tuple[float, float, float] | None
) -> None:
    """A force (N) shared out by volume, at a place or at the centroids of the blocks."""
    density = np.where(np.isin(np.arange(len(layout.volume)), chosen), 1.0 / layout.volume[chosen].sum(), 0.0)
    if at is None:
        add_gravity(layout, load, density, force)
        return
    if layout.meshed[chosen].any():
        raise SceneError("limit.at: a force on blocks of tets acts throughout them; leave the place out")
    for b in chosen.tolist():
        add_force(layout, load, b, density[b] * layout.volume[b] * force, np.array(at) - layout.centroid[b])


def _axis(direction: str | None) -> int:
    assert direction is not None
    return "xyz".index(direction[-1])


def _sign(direction: str | None) -> float:
    assert direction is not None
    return -1.0 if direction[0] == "-" else 1.0
