"""Solids from STEP, IGES and BREP files: flat-faced blocks with the names and colours of the file.

The CAD kernel can crash on a damaged file and keeps settings for the life of a process: call read_cad by
`geometry.files.sandbox.guarded`.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Imported
from geometry.files.step_labels import Label, labels, match
from geometry.files.step_reader import length_unit, records
from geometry.meshes.gmsh_session import gmsh_model
from geometry.polyhedra.construct import from_faces
from geometry.polyhedra.convexity import convex_pieces
from geometry.polyhedra.measures import volumes
from geometry.polyhedra.shells import outward
from geometry.polyhedra.weld import weld

STEP, IGES = (".step", ".stp"), (".iges", ".igs")
MOST_SOLIDS = 50_000
MILLIMETRE = 1e-3  # m, the unit of the CAD kernel
EXACT = 1e-9  # relative error of the volume of a flat-faced solid
MOST_CHANGE = 0.05  # relative change of the volume by flat facets
CHORD = 1e-3  # of the median size of the solids


@dataclass(frozen=True)
class _Solid:
    """One solid in mm: convex faces, the vertices of the file, the volume by the kernel."""

    faces: list[np.ndarray]
    corners: np.ndarray
    volume: float
    flat: bool


def read_cad(path: Path | str, unit: float | None = None, facet: float | None = None) -> Imported:
    """The solids of a CAD file, each as one block; a block that is not convex has several convex pieces to a face.

    unit   m, what 1 in the file stands for; STEP and IGES files say so themselves (for STEP, unit overrules the file)
    facet  m, how far a flat facet may be off a curved face; 1/1000 of the solids' median size if left out
    Raises GeometryError for a file that holds no closed solids.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    notes: list[str] = []
    entries: list[Label] = []
    scale = MILLIMETRE
    if suffix in STEP:
        entries, scale = _step_labels(path, unit, notes)
    elif suffix in IGES:
        notes.append("IGES is read as far as possible: names may be lost; STEP is the better choice")
        if unit is not None:
            raise GeometryError("an IGES file says its own unit of length; leave out --unit")
    else:
        scale = MILLIMETRE if unit is None else unit
        taken = f"the lengths are taken as {scale:g} m" + ("" if unit is not None else "; --unit gives another unit")
        notes.append(f"BREP files hold neither names nor a unit: {taken}")
    with gmsh_model({"Geometry.OCCImportLabels": float(suffix in IGES), **facet_options(1.0)}) as gmsh:
        tags = _import(gmsh, path)
        sizes, extent = _sizes(gmsh, tags)
        chord = facet / scale if facet is not None else CHORD * float(np.median(sizes))
        for option, value in facet_options(chord).items():
            gmsh.option.setNumber(option, value)
        titles = [label.name for label in entries] if len(entries) == len(tags) else [""] * len(tags)
        called = {t: f"'{title}'" if title else f"solid {t}" for t, title in zip(tags, titles, strict=True)}
        solids = _polyhedra(gmsh, called, extent)
        if suffix in IGES:
            entries = [Label(gmsh.model.getEntityName(3, t).split("/")[-1], None, s.corners) for t, s in solids.items()]
    names, colours = _labelled(entries, list(solids.values()), notes)
    notes += _curved_notes(list(solids.values()), chord * scale)
    blocks = from_faces(
        [[face * scale for face in solid.faces] for solid in solids.values()],
        range(len(solids)),
        [0] * len(solids),
        ("units",),
    )
    return Imported(blocks, names, colours, None, tuple(notes))


def _step_labels(path: Path, unit: float | None, notes: list[str]) -> tuple[list[Label], float]:
    """Labels with corners in mm as the kernel sees them, and m for each mm of the kernel."""
    entities = records(path.read_text(encoding="latin-1"))
    if not entities:
        raise GeometryError(f"'{path.name}' is no STEP file, or it is damaged: there are no entities in it")
    entries = labels(entities, MOST_SOLIDS)
    try:
        stated = length_unit(entities)
    except GeometryError as error:
        if unit is not None:
            raise
        notes.append(f"names and colours are left out: {error}")
        return [], MILLIMETRE
    to_kernel = stated / MILLIMETRE
    entries = [Label(label.name, label.colour, label.corners * to_kernel) for label in entries]
    if unit is not None and abs(unit / stated - 1) > 1e-9:
        notes.append(f"the file states its lengths in {stated:g} m; they are taken as {unit:g} m, as --unit says")
    return entries, MILLIMETRE * (unit / stated if unit is not None else 1.0)


def _import(gmsh: Any, path: Path) -> list[int]:
    """Tags of the solids, after the file has been read; the kernel turns STEP and IGES into mm."""
    try:
        gmsh.model.occ.importShapes(str(path))
        gmsh.model.occ.synchronize()
    except Exception as error:  # gmsh raises bare Exception
        raise GeometryError(f"'{path.name}' cannot be read: {str(error)[:200]}; is it damaged?") from error
    tags = [tag for _, tag in gmsh.model.getEntities(3)]
    faces = len(gmsh.model.getEntities(2))
    if not tags:
        what = f"only {faces} faces that close no solid" if faces else "nothing"
        raise GeometryError(f"'{path.name}' holds no solids, {what}; export solids from the CAD program, best as STEP")
    if len(tags) > MOST_SOLIDS or faces > 20 * MOST_SOLIDS:
        raise GeometryError(f"'{path.name}' holds {len(tags)} solids with {faces} faces; at most {MOST_SOLIDS} solids")
    return tags


def _sizes(gmsh: Any, tags: list[int]) -> tuple[np.ndarray, float]:
    """(B,) diagonal of the box round each solid, and the longest side of the box round all, mm."""
    box = np.array([gmsh.model.occ.getBoundingBox(3, tag) for tag in tags])
    return np.linalg.norm(box[:, 3:] - box[:, :3], axis=1), float((box[:, 3:].max(axis=0) - box.min(axis=0)[:3]).max())


def _polyhedra(gmsh: Any, called: dict[int, str], extent: float) -> dict[int, _Solid]:
    points, triangles = triangulate(gmsh, extent)
    width = 1e-9 * extent
    vertex = {v: gmsh.model.getValue(0, v, []) for _, v in gmsh.model.getEntities(0)}
    straight = {c for _, c in gmsh.model.getEntities(1) if gmsh.model.getType(1, c) == "Line"}
    solids = {}
    for tag, name in called.items():
        surfaces = sorted({s for _, s in gmsh.model.getBoundary([(3, tag)], oriented=False)})
        edges = {c for _, c in gmsh.model.getBoundary([(2, s) for s in surfaces], combined=False, oriented=False)}
        ends = {v for _, v in gmsh.model.getBoundary([(1, c) for c in edges], combined=False, oriented=False)}
        flat = edges <= straight and all(gmsh.model.getType(2, s) == "Plane" for s in surfaces)
        faces = _faces(points, [triangles[s] for s in surfaces], width, name)
        corners = np.array([vertex[v] for v in sorted(ends)])
        solids[tag] = _Solid(faces, corners, float(gmsh.model.occ.getMass(3, tag)), flat)
        _require_volume(solids[tag], name)
    return solids


def _faces(points: np.ndarray, surfaces: list[np.ndarray], width: float, solid: str) -> list[np.ndarray]:
    """Convex faces of a solid from the triangles of its surfaces."""
    looking = outward(points, np.concatenate(surfaces), solid)
    ends = np.cumsum([len(part) for part in surfaces])[:-1]
    pieces = [piece for part in np.split(looking, ends) for piece in convex_pieces(points, part, width)]
    return [points[piece] for piece in pieces]


def _require_volume(solid: _Solid, name: str) -> None:
    volume = _volume(solid)
    if not volume > 0 or not solid.volume > 0:
        raise GeometryError(f"{name} has no volume ({solid.volume:.3g} mm^3); mend it in the CAD program")
    change = abs(volume / solid.volume - 1)
    if solid.flat and change > EXACT:
        raise GeometryError(f"{name}: its faces enclose {volume:.9g} mm^3, the file says {solid.volume:.9g} mm^3")
    if change > MOST_CHANGE:
        raise GeometryError(f"{name}: flat facets change its volume by {change:.1%}; take a smaller --facet")


def _volume(solid: _Solid) -> float:
    return float(volumes(from_faces([solid.faces], [0], [0], ("",)))[0])


def _labelled(
    entries: list[Label], solids: list[_Solid], notes: list[str]
) -> tuple[tuple[str, ...], np.ndarray | None]:
    number = match(entries, [solid.corners for solid in solids])
    names = tuple(entries[n].name if n >= 0 else "" for n in number)
    matched = set(number.tolist())
    lost = [label.name or "one without a name" for n, label in enumerate(entries) if n not in matched]
    if len(entries) > len(solids):
        raise GeometryError(
            f"the file holds {len(entries)} solids and {len(solids)} of them can be read; lost: "
            f"{', '.join(lost[:10])}; is it damaged?"
        )
    if entries and (number < 0).any():
        notes.append(f"{np.sum(number < 0)} solids have no name: no name in the file belongs to them")
    colours = np.full((len(solids), 3), np.nan)
    for row, n in enumerate(number):
        if n >= 0 and entries[n].colour is not None:
            colours[row] = entries[n].colour
    return names, None if np.isnan(colours).all() else colours


def _curved_notes(solids: list[_Solid], chord: float) -> list[str]:
    curved = [solid for solid in solids if not solid.flat]
    if not curved:
        return []
    exact, faceted = (sum(map(of, curved)) for of in (lambda solid: solid.volume, _volume))
    worst = max(abs(_volume(solid) / solid.volume - 1) for solid in curved)
    return [
        f"{len(curved)} solids have curved faces or edges: flat facets within about {chord * 1e3:.3g} mm change their "
        f"volume by {faceted / exact - 1:+.2e} in all, a single one by at most {worst:.2e}"
    ]


TRIANGLE = 2
SAME = 1e-6  # mm, corners of neighbouring faces nearer than this are one
LARGEST_ANGLE = 1.0  # rad between neighbouring facets
MOST_TRIANGLES = 5_000_000


def facet_options(chord: float) -> dict[str, float]:
    """Options under which the kernel divides faces into triangles off the faces by no more than chord (mm)."""
    return {
        "Mesh.StlLinearDeflection": chord,
        "Mesh.StlLinearDeflectionRelative": 0.0,
        "Mesh.StlAngularDeflection": LARGEST_ANGLE,
    }


def triangulate(gmsh: Any, extent: float) -> tuple[np.ndarray, dict[int, np.ndarray]]:
    """Corners (P, 3) mm, each once, and for each face of the model its triangles (T, 3); extent mm, of the model.

    This is the kernel's own triangulation for pictures. gmsh's mesher leaves the surface where triangles are long.
    """
    try:
        gmsh.model.mesh.importStl()
    except Exception as error:  # gmsh raises bare Exception
        raise GeometryError(f"the faces of the solids cannot be divided into triangles: {str(error)[:200]}") from error
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    if len(tags) == 0 or len(tags) > MOST_TRIANGLES:
        raise GeometryError(f"the faces of the solids make {len(tags)} corners of facets; take a larger --facet")
    if not np.isfinite(coordinates).all():
        raise GeometryError("the file holds corners at infinity; is it damaged?")
    points = coordinates.reshape(-1, 3)
    first, number = weld(points, max(SAME, 1e-9 * extent))
    of_tag = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    of_tag[tags.astype(np.int64)] = number
    triangles = {}
    for _, surface in gmsh.model.getEntities(2):
        corners = of_tag[gmsh.model.mesh.getElementsByType(TRIANGLE, surface)[1].astype(np.int64).reshape(-1, 3)]
        flat = (corners[:, 0] == corners[:, 1]) | (corners[:, 1] == corners[:, 2]) | (corners[:, 2] == corners[:, 0])
        triangles[surface] = corners[~flat]
    return points[first], triangles
