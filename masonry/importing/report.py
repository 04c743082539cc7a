"""Report of `masonry import` on what it found and did: data, rows of a table, and the scene that came of it."""

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from geometry.blocks import JointPolygons, Joints, Specimen
from geometry.joints.gaps import LISTED, Facing, described
from geometry.joints.heal import Mended
from geometry.polyhedra.measures import bounds, volumes
from masonry.runtime.tables import aligned

if TYPE_CHECKING:
    from masonry.scene import Scene


@dataclass(frozen=True, repr=False)
class ImportReport:
    """Result of an import: the specimen, its joints, what was mended, sentences of the reader, the files that were
    written, what the section is, name and text of the scene. It prints as `masonry import` does."""

    specimen: Specimen
    joints: Joints
    mended: Mended | None
    names: tuple[str, ...]
    notes: tuple[str, ...]
    paths: tuple[Path, ...]
    section_is: str
    name: str
    scene_text: str

    @property
    def scene(self) -> "Scene":
        """The scene on these blocks, with its placeholders."""
        from masonry.scene import load

        return load(self.paths[0] if self.paths else {"name": self.name, **tomllib.loads(self.scene_text)})

    def __repr__(self) -> str:
        return aligned(report_text(self))


def report_text(report: ImportReport) -> list[tuple[str, list[str]]]:
    """Rows of a table: groups with counts and volumes, joints, gaps and overlaps, files, notes."""
    blocks, volume = report.specimen.blocks, volumes(report.specimen.blocks)
    rows = [
        f"{name}: {np.sum(blocks.group == g)} blocks, {volume[blocks.group == g].sum():.6g} m^3"
        for g, name in enumerate(blocks.groups)
    ]
    low, high = bounds(blocks)
    span = " x ".join(f"{side * 1e3:.6g}" for side in high.max(axis=0) - low.min(axis=0))
    joints = len(report.joints.patch_start) - 1
    ends = zip("xyz", low.min(axis=0) * 1e3, high.max(axis=0) * 1e3, strict=True)
    where = ", ".join(f"{axis} {low:.6g} to {high:.6g}" for axis, low, high in ends)
    table = [
        ("groups", rows),
        ("size", [f"{span} mm ({where})"]),
        ("joints", [f"{joints} polygons, {report.joints.area.sum():.9g} m^2", *_alone(report)]),
        ("section", [f"{report.specimen.section:.6g} m^2: {report.section_is}"]),
    ]
    if report.mended is not None:
        table += _mended_rows(report)
    if report.specimen.joints is not None:
        table.append(("bridged", _bridged(report.specimen.joints)))
    table.append(("notes", list(report.notes) or ["none"]))
    return [*table, ("written", [str(path) for path in report.paths])] if report.paths else table


def _alone(report: ImportReport) -> list[str]:
    """Blocks that touch nothing, where there are others."""
    touching = np.union1d(report.joints.block_a, report.joints.block_b)
    alone = np.setdiff1d(np.arange(report.specimen.blocks.count), touching)
    if len(alone) == 0 or report.specimen.blocks.count == 1:
        return []
    named = ", ".join(f"'{report.names[b]}'" for b in alone[:LISTED])
    more = ", ..." if len(alone) > LISTED else ""
    near = "" if report.specimen.joints else "; --gap LENGTH makes joints between those that only nearly meet"
    return [f"{len(alone)} blocks have none: {named}{more}{near}"]


def _bridged(joints: JointPolygons) -> list[str]:
    """How far the blocks are apart in joints that were laid over gaps."""
    low, high = joints.gap.T
    middle = joints.gap.mean(axis=1)
    near = 1e-6
    open_, deep = high > near, low < -near
    meet = len(high) - int(np.sum(open_ | deep))
    lines = [f"in {meet} joints blocks meet within {near * 1e3:g} mm"]
    if open_.any():
        lines.append(
            f"in {open_.sum()} they are up to {high.max() * 1e3:.3g} mm apart, {middle[open_].mean() * 1e3:.3g} mm on "
            "average"
        )
    if deep.any():
        lines.append(f"in {deep.sum()} they overlap, by up to {-low.min() * 1e3:.3g} mm")
    return [*lines, "the joints lie half way; the blocks stay as they are"]


def _mended_rows(report: ImportReport) -> list[tuple[str, list[str]]]:
    mended = report.mended
    assert mended is not None
    rows = [("mended", _counted(report, mended.gaps) or ["nothing: no gaps and no overlaps"])]
    if len(mended.gaps.size):
        change, worst = mended.volume_change, int(np.argmax(np.abs(mended.volume_change)))
        after = volumes(mended.blocks)
        total = after.sum() / (after / (1 + change)).sum() - 1
        rows.append(("volume", [f"{total:+.3g} in all, at most {change[worst]:+.3g} ('{report.names[worst]}')"]))
    if mended.deepest:
        rows.append(("overlaps", [f"of less than {mended.deepest * 1e3:.3g} mm at edges and corners are left"]))
    if len(mended.left.size):
        rows.append(("left open", _counted(report, mended.left)))
    return rows


def _counted(report: ImportReport, facing: Facing) -> list[str]:
    gaps, overlaps = int(np.sum(facing.size > 0)), int(np.sum(facing.size < 0))
    if gaps + overlaps == 0:
        return []
    assert report.mended is not None
    return [f"{gaps} gaps and {overlaps} overlaps", *described(report.mended.blocks, facing, report.names)]
