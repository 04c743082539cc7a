"""`masonry import`: a file of solids or of a mesh becomes a file of blocks and a scene that can be run at once."""

import math
import os
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Imported, JointPolygons, Specimen
from geometry.files.atomic import whole_file
from geometry.files.blocks_h5 import save_blocks
from geometry.files.blocks_text import text_of_blocks
from geometry.files.sandbox import guarded
from geometry.files.surfaces.compas_json import SUPPORT
from geometry.joints.find import find_joints, stated_joints
from geometry.joints.gaps import ALMOST, Unmended
from geometry.joints.heal import Mended, mend
from geometry.joints.nearby import Rule, nearby_joints
from geometry.joints.point_density import Density
from geometry.polyhedra.overlaps import Overlapping, check_overlaps
from geometry.polyhedra.validate import require_near, require_sound
from masonry.errors import SceneError, nearest
from masonry.importing.data_sets import data_path
from masonry.importing.hints import needed_by, ways_out, with_ways_out
from masonry.importing.named_sets import SECTIONS, section_of, section_words, sets_of
from masonry.importing.report import ImportReport
from masonry.importing.scene_file import Written, scene_text

SURFACES = ("geometry.files.surfaces.reader", "read_surfaces")
READERS = {
    **dict.fromkeys((".step", ".stp", ".iges", ".igs", ".brep"), ("geometry.files.cad", "read_cad")),
    ".tess": ("geometry.files.tess", "read_tess"),
    **dict.fromkeys((".msh", ".vtu"), ("geometry.files.mesh_files", "read_mesh")),
    **dict.fromkeys((".obj", ".ply", ".stl", ".json"), SURFACES),
}
TOLERANCE = 1e-4  # m
FLAT = 1.0, 0.1, 0.0  # of the tolerance, within which faces of a surface count as flat
HOPELESS = 3.0  # times the tolerance: making faces flat moves both sides of a gap by no more than once each

ANGLE = math.radians(20.0)
SUFFIX = ".blocks.h5"
LONGEST_NAME = 200  # letters, what a scene allows
LISTED = 5  # names that a note shows
MANY = 100  # blocks, from which on it is told what is looked for: it may take seconds
UPWARD = {"x": (1, 2, 0), "y": (2, 0, 1), "z": (0, 1, 2)}
"""Axes of the file that become x, y and z: what points up becomes z, the others follow in their order round."""


@dataclass(frozen=True)
class ImportSettings:
    """Settings of the user for a file: unit, tolerance of gaps, thickness of plane cells, chord height of facets (all
    m), groups, section (m2); the axis that points up; the widest hole of a surface that is closed (m); the widest gap
    over which faces make a joint (m), and the angle (rad) within which they look at each other."""

    unit: float | None = None
    tolerance: float = TOLERANCE
    thickness: float | None = None
    facet: float | None = None
    groups: Sequence[tuple[str, str]] = ()
    section: float | None = None
    open_gaps: bool = False
    up: str = "z"
    holes: float | None = None
    gap: float | None = None
    angle: float = ANGLE


def import_file(
    source: Path,
    out: Path | None,
    wishes: ImportSettings,
    overwrite: bool = False,
    tell: Callable[[str], None] | None = None,
) -> ImportReport:
    """Read source, mend it, and make a scene of it: in the file `out`, with its blocks beside it; without `out` nothing
    is written, and the blocks stand in the scene.

    tell  gets a line each time that many blocks are looked at
    Raises SceneError or GeometryError with one message; then nothing is written.
    """
    source = data_path(source)
    reader = SURFACES if source.is_dir() else READERS.get(source.suffix.lower())
    if reader is None:
        raise SceneError(f"'{source}': {source.suffix or 'a file without suffix'} is not read; {nearest('', READERS)}")
    target = None if out is None else out.parent / (out.name.removesuffix(".toml") + SUFFIX)
    if out is not None and target is not None:
        _require_free(source, out, target, overwrite)
    read = Reading(source, reader, tell or _say_nothing)
    try:
        solids, names, mended, stated = joined_up(read, wishes)
    except (Unmended, Overlapping) as error:
        raise with_ways_out(error, ways_out(partial(joined_up, read), wishes, error)) from None
    specimen = _specimen(source, solids, mended, stated, wishes)
    blocks = specimen.blocks
    joints = find_joints(blocks) if stated is None else stated_joints(stated, Density())
    words, is_dry = section_words(blocks, wishes.section), reader == SURFACES
    content = "" if target is not None else text_of_blocks(specimen, solids.mesh)
    file = "" if target is None else target.name
    text = scene_text(specimen, joints, Written(_readable(source.name), file, words, is_dry, content))
    if out is not None and target is not None:
        with whole_file(out) as place:
            place.write_text(text, encoding="utf-8", newline="\n")
            save_blocks(target, specimen, solids.mesh)
    notes = (*solids.notes, *_lone(blocks), *_shared_names(names))
    paths = (out, target) if out is not None and target is not None else ()
    return ImportReport(specimen, joints, mended, names, notes, paths, words, _readable(source.stem), text)


def _specimen(
    source: Path, solids: Imported, mended: Mended | None, stated: JointPolygons | None, wishes: ImportSettings
) -> Specimen:
    """Sound blocks with their sets and a section that a scene allows."""
    blocks = mended.blocks if mended else solids.blocks
    require_sound(blocks)
    section = section_of(blocks, wishes.section)
    if not SECTIONS[0] <= section <= SECTIONS[1]:
        raise SceneError(
            f"'{source}': its section, {section_words(blocks, wishes.section)}, has {section:.3g} m^2, allowed: "
            f"{SECTIONS[0]:g} to {SECTIONS[1]:g} m^2; say by --unit which length 1 in the file means"
        )
    sets = sets_of(blocks, solids.names, wishes.gap or 0.0)
    return Specimen(blocks, sets, section, "file", joints=stated, overlap=mended.deepest if mended else 0.0)


def _say_nothing(line: str) -> None:
    """Receiver of lines that tells nobody."""


def _lone(blocks) -> list[str]:
    """Limits of a file of one solid, in a sentence."""
    if blocks.count > 1:
        return []
    return [
        "the file holds one solid: it has no joint, so nothing can open, slide or crush; if it was meant to be "
        "several, they were fused where it was made: export them apart, or divide it by `divisions` in the scene"
    ]


def _shared_names(names: Sequence[str]) -> list[str]:
    """That some names stand for several blocks each; supports of COMPAS are meant so."""
    several = [f"'{name}' ({times})" for name, times in Counter(names).items() if times > 1 and name != SUPPORT]
    if not several:
        return []
    more = ", ..." if len(several) > LISTED else ""
    return [
        f"names of several blocks: {', '.join(several[:LISTED])}{more}; a support, load or gauge by one of these "
        "takes all of its blocks"
    ]


class Reading:
    """A file that is read, once for each way of reading it."""

    def __init__(self, source: Path, reader: tuple[str, str], tell: Callable[[str], None]) -> None:
        self.source, self.reader, self.tell = source, reader, tell
        self._read: dict[str, Imported] = {}

    def __call__(self, wishes: ImportSettings, flat: float = 0.0) -> tuple[Imported, tuple[str, ...]]:
        """The blocks of the file and their names; flat (m): faces of surfaces that are flat within it are flat."""
        words: dict[str, Any] = {} if wishes.unit is None else {"unit": wishes.unit}
        words |= _words_of_one_kind(self.source, self.reader, wishes)
        words |= {"flat": flat} if flat else {}
        key = repr(words)
        if key not in self._read:
            self._read[key] = upright(guarded(*self.reader, self.source, **words), wishes.up)
        solids = self._read[key]
        if solids.blocks.count > MANY:
            within = wishes.tolerance if wishes.gap is None else wishes.gap
            self.tell(f"{solids.blocks.count} blocks: looks for gaps and overlaps, up to {within * 1e3:.4g} mm")
        require_near(solids.blocks)
        names = tuple(name or f"solid {number}" for number, name in enumerate(solids.names, start=1))
        return grouped(solids, names, wishes.groups), names


def joined_up(
    read: Reading, wishes: ImportSettings
) -> tuple[Imported, tuple[str, ...], Mended | None, JointPolygons | None]:
    """The solids of a file, their names, and what was mended, or the joints that were laid over gaps."""
    if wishes.gap is not None:
        solids, names = read(wishes)
        return solids, names, None, bridged(solids, names, wishes)
    if read.reader == SURFACES:
        return (*_mended_surfaces(read, wishes), None)
    solids, names = read(wishes)
    if read.reader[0] == "geometry.files.cad":
        return solids, names, mend(solids.blocks, wishes.tolerance, names, wishes.open_gaps), None
    check_overlaps(solids.blocks, names)
    return solids, names, None, None


def _words_of_one_kind(source: Path, reader: tuple[str, str], wishes: ImportSettings) -> dict[str, Any]:
    """Words that only readers of one kind of file understand. Raises SceneError where another kind is given them."""
    words: dict[str, Any] = {}
    if wishes.facet is not None and reader[0] == "geometry.files.cad":
        words["facet"] = wishes.facet
    if wishes.thickness is not None:
        if source.suffix.lower() != ".tess":
            raise SceneError(f"--thickness: only plane .tess files need it, not '{source}'")
        words["thickness"] = wishes.thickness
    if wishes.holes is not None:
        if reader != SURFACES:
            raise SceneError(f"--holes: only surfaces (.obj, .ply, .stl, .json) may have holes, not '{source}'")
        words["holes"] = wishes.holes
    return words


def upright(solids: Imported, up: str) -> Imported:
    """The solids turned so that an axis of the file points up: z, with the other two in their order round."""
    if up == "z":
        return solids
    order = list(UPWARD[up])
    mesh = solids.mesh and replace(solids.mesh, nodes=solids.mesh.nodes[:, order])
    return replace(solids, blocks=replace(solids.blocks, points=solids.blocks.points[:, order]), mesh=mesh)


def _mended_surfaces(read: Reading, wishes: ImportSettings) -> tuple[Imported, tuple[str, ...], Mended]:
    """The bodies of a surface, their names, and how they were mended.

    Faces count as flat within the tolerance; where blocks cannot be mended so, as faces that are slightly bent need not
    agree with their neighbours, within less.
    """
    refused: GeometryError | None = None
    before: np.ndarray | None = None
    for fraction in FLAT:
        solids, names = read(wishes, fraction * wishes.tolerance)
        if before is not None and np.array_equal(before, solids.blocks.points):
            continue  # these were refused
        before = solids.blocks.points
        try:
            return solids, names, mend(solids.blocks, wishes.tolerance, names, wishes.open_gaps)
        except GeometryError as error:
            refused = refused or error
            if (needed_by(error) or 0.0) > HOPELESS * wishes.tolerance:
                break
    assert refused is not None
    if far := [note for note in solids.notes if "from the origin" in note]:
        raise GeometryError(f"{refused}; {far[0]}")
    raise refused


def bridged(solids: Imported, names: Sequence[str], wishes: ImportSettings) -> JointPolygons:
    """The joints over gaps of up to `wishes.gap`, between blocks that overlap by no more than the tolerance.

    Raises GeometryError for deeper overlaps, and where nothing is near anything.
    """
    assert wishes.gap is not None
    if solids.mesh is not None:
        raise SceneError("--gap: tets need blocks that meet; leave it out")
    check_overlaps(solids.blocks, names, wishes.tolerance)
    stated = nearby_joints(solids.blocks, Rule(wishes.gap * (1 + ALMOST), wishes.tolerance, wishes.angle))
    if len(stated.block_a) == 0 and solids.blocks.count > 1:
        raise GeometryError(
            f"--gap {wishes.gap * 1e3:.4g} mm: no two blocks are so near each other; is the unit right, and the gap?"
        )
    return stated


def _require_free(source: Path, out: Path, target: Path, overwrite: bool) -> None:
    if out.suffix != ".toml":
        raise SceneError(f"--out '{out}': must be the name of a scene, for example '{source.stem}.toml'")
    if _readable(out.name) != out.name or len(out.stem) > LONGEST_NAME:
        raise SceneError(f"--out '{out}': no name of a scene; give one in UTF-8, at most {LONGEST_NAME} letters long")
    if not os.path.isdir(out.parent):
        raise SceneError(f"--out '{out}': the folder '{out.parent}' does not exist")
    there = [str(path) for path in (out, target) if os.path.lexists(path)]
    if there and not overwrite:
        raise SceneError(f"'{there[0]}' exists already; --overwrite replaces it")
    if folders := [str(path) for path in (out, target) if os.path.isdir(path)]:
        raise SceneError(f"'{folders[0]}' is a folder; give another --out")


def _readable(name: str) -> str:
    """A name that may hold bytes which are no text, as text."""
    return name.encode("utf-8", "replace").decode()


def grouped(solids: Imported, names: Sequence[str], rules: Sequence[tuple[str, str]]) -> Imported:
    """The blocks in the groups of the first rule that fits their name or colour ("#c04020"); else in the file's own."""
    blocks, group_of = solids.blocks, [solids.blocks.groups[g] for g in solids.blocks.group]
    painted = [""] * blocks.count if solids.colours is None else [_hex(colour) for colour in solids.colours]
    used = set()
    for b, (name, colour) in enumerate(zip(names, painted, strict=True)):
        for pattern, group in reversed(rules):
            if fnmatchcase(name, pattern) or (colour and fnmatchcase(colour, pattern.lower())):
                group_of[b] = group
                used.add(pattern)
    for pattern, group in rules:
        if pattern not in used:
            known = sorted({*names, *filter(None, painted)})[:20]
            raise SceneError(
                f"--group '{pattern}={group}': no solid has such a name or colour; {nearest(pattern, known)}"
            )
    groups = tuple(dict.fromkeys(group_of))
    number = np.array([groups.index(name) for name in group_of], dtype=np.int64)
    return replace(solids, blocks=replace(blocks, group=number, groups=groups))


def _hex(colour: np.ndarray) -> str:
    if not np.isfinite(colour).all():
        return ""
    return "#" + "".join(f"{round(255 * float(part)):02x}" for part in np.clip(colour, 0, 1))
