"""Resolution of a scene: settings that say how finely a model is solved, and nothing about the model."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from masonry.assembly.contact_pairs import points_along
from masonry.scene import Scene
from masonry.sweeps.convergence.refinement.answers import EXACT

FINEST_ACCURACY = 1e-4
MOST_ALONG_PATCH, MOST_ROWS = 40, 1_000_000
"""The finest that a scene takes."""
ALONG = "points along "
PATCHES = "points of patches"
ONE_AXIS, ALL_EDGES = tuple(f"{ALONG}{axis}" for axis in "xyz"), (f"{ALONG}all edges",)
"""Names of what refines points along the edges of joints: by axis, or of joints that are no parallelograms all at once,
as the fewest along any two axes count in these."""
DOUBLED, FROM_EDGES, MESH = (2.0, 4.0), (4.0, 8.0), (1.0 / 1.5, 1.5, 2.25)
"""Factors of refinement that are tried one after the other. Half the size of tets costs ten to sixteen times as much,
so that a coarser mesh stands on the other side of the scene's, and the finest is for those who allow its cost. Two and
four points from edge to edge bear alike where blocks turn about their edges, and tell nothing."""
FEW_AT_EDGES = 4
"""Points from edge to edge, below which they are made FROM_EDGES as many."""


@dataclass(frozen=True)
class Resolution:
    """One setting of a scene, or several that go together.

    name      in plain words
    settings  of a factor by which it is made finer (below 1: coarser): what is set, by dotted key; None where the
              scene does not take it
    factors   of refinement that are tried, in their order
    at_edges  of a factor, how many points from edge to edge, both ends among them, a joint has; None where points lie
              inside
    """

    name: str
    settings: Callable[[float], dict[str, Any] | None]
    factors: tuple[float, ...] = DOUBLED
    at_edges: Callable[[float], int] | None = None


def resolutions_of(scene: Scene) -> list[Resolution]:
    """All that a run of a scene has, the cheapest to refine first."""
    return [*_of_time(scene), *_of_points(scene), *_of_patches(scene), *_of_mesh(scene)]


def of_space(scene: Scene) -> list[Resolution]:
    """Those that need no run: points of joints and tets."""
    return [*_of_points(scene), *_of_mesh(scene)]


def jitter(scene: Scene, factor: float) -> dict[str, Any]:
    """Settings that differ from those of a scene by next to nothing: what they move is scatter."""
    settings = _time_step(scene, factor)
    for resolution in _of_time(scene):
        settings |= resolution.settings(factor) or {}
    return settings


def _of_time(scene: Scene) -> Iterator[Resolution]:
    """The pace of a quasi-static test, dead loads that settle included, or the time step of a motion."""
    if scene.solver.masses == "real":
        yield Resolution("time step", lambda factor: _time_step(scene, factor))
    elif _pace(scene, 1.0):
        yield Resolution("pace", lambda factor: _pace(scene, factor))
    if scene.grows:
        yield Resolution("trials", lambda factor: _trials(scene, factor))


def _time_step(scene: Scene, factor: float) -> dict[str, Any]:
    """The step that is given, or the fraction of its bound; and of a motion in time the rows at which it is read."""
    step = scene.solver.time_step
    rows = _rows(scene, factor) if scene.solver.masses == "real" else {}
    if isinstance(step, float):
        return {"solver.time_step": f"{step / factor!r} s"} | rows
    return {"solver.step_fraction": scene.solver.step_fraction / factor} | rows


def _rows(scene: Scene, factor: float) -> dict[str, Any]:
    """Rows a second, or in all, between which a gauge may read more; none where a gauge reads an acceleration, whose
    band they are, and where increments say how many there are."""
    if scene.is_controlled or scene.grows or any(gauge.quantity == "acceleration" for gauge in scene.gauge):
        return {}
    if scene.sampling is not None:
        return {"solver.sampling": f"{scene.sampling * factor!r} Hz"}
    return {"solver.rows": min(max(round(scene.solver.rows * factor), 2), MOST_ROWS)}


def _trials(scene: Scene, factor: float) -> dict[str, Any] | None:
    """The accuracy of a load that grows: how near its trials come to each other, how long its increments are, how much
    at rest it must be, and how near to equilibrium a branch is led. It is never coarser, as the interval of the factor
    would be as well."""
    assert scene.limit is not None and scene.limit.run_accuracy is not None
    finer = scene.limit.run_accuracy / factor
    return {"limit.accuracy": finer} if factor >= 1.0 and finer >= FINEST_ACCURACY else None


def _pace(scene: Scene, factor: float) -> dict[str, Any] | None:
    """Settings of a pace that is slower by a factor; empty where a scene says nothing of it."""
    drive, tilt = scene.drive, scene.gravity.tilt if scene.gravity is not None else None
    settings: dict[str, Any] = {}
    if drive is not None and drive.accuracy is not None:
        if drive.accuracy / factor < FINEST_ACCURACY:
            return None
        settings["drive.accuracy"] = drive.accuracy / factor
    elif drive is not None and drive.steps is not None:
        settings["drive.steps"] = round(drive.steps * factor)
    elif drive is not None and drive.rate is not None:
        settings["drive.rate"] = f"{drive.rate / factor!r} m/s"
    if tilt is not None and tilt.steps is not None:
        settings["gravity.tilt.steps"] = round(tilt.steps * factor)
    if scene.settle is not None and scene.settle.steps:
        settings["settle.steps"] = round(scene.settle.steps * factor)
    return settings


def _of_points(scene: Scene) -> Iterator[Resolution]:
    """Contact points along the edges of joints, by the axis of these, or on a face, or by their distance."""
    spec, number = scene.specimen, scene.points_per_edge
    if number is not None:
        for name, axes in (*zip(ONE_AXIS, "xyz", strict=True), (*ALL_EDGES, "xyz")):
            yield _along(name, axes, number._asdict(), scene.contact_points == "vertex")
    elif spec.points_per_face is not None:
        per_face = spec.points_per_face
        yield Resolution("points per face", lambda factor: {"specimen.points_per_face": round(per_face * factor**2)})
    elif spec.contact_spacing is not None:
        spacing = spec.contact_spacing
        yield Resolution("spacing of points", lambda factor: {"specimen.contact_spacing": f"{spacing / factor!r} m"})


def _along(name: str, axes: str, number: dict[str, int], from_edges: bool) -> Resolution:
    """Points along the edges of some axes, two at least where they become fewer."""

    def more(factor: float) -> dict[str, int]:
        return {axis: max(round(n * factor), min(n, 2)) if axis in axes else n for axis, n in number.items()}

    def at_edges(factor: float) -> int:
        return min(n for axis, n in more(factor).items() if axis in axes)

    def settings(factor: float) -> dict[str, Any]:
        return {"specimen.points_per_edge": more(factor)}

    if not from_edges:
        return Resolution(name, settings)
    return Resolution(name, settings, FROM_EDGES if at_edges(1.0) < FEW_AT_EDGES else DOUBLED, at_edges)


def _of_patches(scene: Scene) -> Iterator[Resolution]:
    """Points of dry contacts in large displacement: their number where it is given, else that of the program. A kind of
    points that the scene chooses has no number."""
    along = scene.specimen.patch_points_per_edge
    crushes = any(contact.crushing for contact in scene.contact.values())
    if scene.is_large and scene.specimen.patch_points is None:
        yield Resolution(PATCHES, lambda factor: _patch(along or points_along(scene, crushes), factor))


def _patch(along: int, factor: float) -> dict[str, Any] | None:
    number = 2 * max(round(along * factor / 2), 1)
    return {"specimen.patch_points_per_edge": number} if number <= MOST_ALONG_PATCH else None


def _of_mesh(scene: Scene) -> Iterator[Resolution]:
    size = scene.specimen.mesh_size
    if size is not None and scene.specimen.mesh != "fan" and any(map(scene.is_meshed, scene.material)):
        yield Resolution("size of tets", lambda factor: {"specimen.mesh_size": f"{size / factor!r} m"}, MESH)


def not_refined(scene: Scene) -> list[str]:
    """Remarks on settings that a number may rest on besides, and why they are not made finer."""
    spec = scene.specimen
    remarks = [f"A run leaves the load of [limit] out; {EXACT}."] if scene.limit is not None and not scene.grows else []
    if not spec.has_cells and max(getattr(spec, "divisions", None) or (1,)) > 1:
        remarks.append("Blocks of a unit (specimen.divisions) say where cracks may run: they are part of the model.")
    if scene.is_large and spec.patch_points is not None:
        remarks.append(
            "Points of patches are a choice of this scene (specimen.patch_points): specimen.patch_points_per_edge in "
            "its place is refined."
        )
    if any(map(scene.is_meshed, scene.material)) and spec.mesh == "fan":
        remarks.append("A fan of tets (specimen.mesh) has no size: only gmsh makes it finer.")
    return remarks
