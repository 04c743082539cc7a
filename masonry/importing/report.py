"""What `masonry import` found and did, as rows of a table."""

import numpy as np

from geometry.joints.gaps import Facing, described
from geometry.polyhedra.measures import bounds, volumes
from masonry.importing.importing import Report


def report_text(report: Report) -> list[tuple[str, list[str]]]:
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
    where = ", ".join(f"{axis} {least:.6g} to {most:.6g}" for axis, least, most in ends)
    table = [
        ("groups", rows),
        ("size", [f"{span} mm ({where})"]),
        ("joints", [f"{joints} polygons, {report.joints.area.sum():.9g} m^2"]),
        ("section", [f"{report.specimen.section:.6g} m^2"]),
    ]
    if report.mended is not None:
        table += _mended_rows(report)
    table += [("notes", list(report.notes) or ["none"]), ("written", [str(path) for path in report.paths])]
    return table


def _mended_rows(report: Report) -> list[tuple[str, list[str]]]:
    mended = report.mended
    assert mended is not None
    rows = [("mended", _counted(report, mended.found) or ["nothing: no gaps and no overlaps"])]
    if len(mended.found.size):
        change, worst = mended.volume_change, int(np.argmax(np.abs(mended.volume_change)))
        after = volumes(mended.blocks)
        total = after.sum() / (after / (1 + change)).sum() - 1
        rows.append(("volume", [f"{total:+.3g} in all, at most {change[worst]:+.3g} ('{report.names[worst]}')"]))
    if len(mended.left.size):
        rows.append(("left open", _counted(report, mended.left)))
    return rows


def _counted(report: Report, found: Facing) -> list[str]:
    gaps, overlaps = int(np.sum(found.size > 0)), int(np.sum(found.size < 0))
    if gaps + overlaps == 0:
        return []
    assert report.mended is not None
    return [f"{gaps} gaps and {overlaps} overlaps", *described(report.mended.blocks, found, report.names)]
