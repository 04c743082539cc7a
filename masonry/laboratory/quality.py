"""Lines of `masonry check` on the quality of a specimen: worst values, and the block to blame for each."""

from geometry.blocks import CellReport
from geometry.joints.quality import Worst, quality
from geometry.polyhedra.measures import bounds
from masonry.assembly.assemble import Assembly


def quality_lines(assembly: Assembly) -> dict[str, str]:
    """A sentence for each measure, by its name; h is the edge of a cube of the mean volume of a group's blocks."""
    worst = quality(assembly.specimen.blocks, assembly.joints, assembly.mesh)
    lines = {
        "shortest edge": _sentence(assembly, worst.shortest_edge, 1e3, "mm", " h"),
        "smallest block": _sentence(assembly, worst.smallest_block, 1e6, "cm3", " of its group's mean"),
    }
    if worst.shortest_joint_edge and worst.smallest_joint:
        lines["shortest joint edge"] = _sentence(assembly, worst.shortest_joint_edge, 1e3, "mm", " h")
        lines["smallest joint"] = _sentence(assembly, worst.smallest_joint, 1e6, "mm2", " h2")
    if worst.flattest_tet:
        where = _where(assembly, worst.flattest_tet.blocks)
        lines["flattest tet"] = f"radius ratio {worst.flattest_tet.value:.3g} (regular: 1), {where}"
    joints = assembly.joints
    ignored = (
        [f"{joints.dropped} pairs of faces meet in a line or a corner only, as they should"] if joints.dropped else []
    )
    ignored += [f"{joints.repeated} joints were there twice and count once"] if joints.repeated else []
    lines["no joint"] = "; ".join(ignored) or "none"
    lines["cost of the worst"] = _cost(assembly)
    return lines


def _sentence(assembly: Assembly, worst: Worst, factor: float, unit: str, of: str) -> str:
    return f"{worst.value * factor:.3g} {unit}, {worst.ratio:.2g}{of}; {_where(assembly, worst.blocks)}"


def _where(assembly: Assembly, which: tuple[int, ...]) -> str:
    """Numbers, groups and place of one block, or of the two of a joint and of what their boxes share."""
    blocks = assembly.specimen.blocks
    low, high = bounds(blocks)
    names = [f"{b} ({blocks.groups[blocks.group[b]]}, unit {blocks.unit[b]})" for b in which]
    middle = (low[list(which)].max(axis=0) + high[list(which)].min(axis=0)) / 2 * 1e3
    word = "block" if len(which) == 1 else "blocks"
    return f"{word} {' and '.join(names)} at ({', '.join(f'{x:.4g}' for x in middle)}) mm"


def _cost(assembly: Assembly) -> str:
    cost = assembly.model.cost
    if cost is None:
        return "none: fewer than two blocks move"
    if cost.usual < 1.005:
        return "none: all blocks that move allow the same time step"
    return (
        f"the time step would be {_longer(cost.usual)} if no block were worse than the median, "
        f"{_longer(cost.without)} without the worst, {_where(assembly, (cost.block,))}"
    )


def _longer(ratio: float) -> str:
    return f"{ratio:.2g} times as long" if ratio >= 2 else f"{ratio - 1:.1%} longer"


def cells_text(report: CellReport) -> str:
    """Result of a division into cells, in one line; h is the mean size of a cell."""
    joint = "" if report.shortest_joint is None else f", shortest joint piece {report.shortest_joint:.2g} h"
    return (
        f"{report.count} of h = {report.h * 1e3:.3g} mm: shortest edge {report.shortest_over_mean:.2g} of the mean, "
        f"{report.small_edges:.1%} small, sizes within {report.size_error:.1%}{joint}"
    )
