"""How cracks are drawn: red where tension damaged more and blue where shear did, darker by damage, wider by opening."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.pictures.camera import Camera
from masonry.pictures.crack_lines import CrackLines
from masonry.pictures.style import MILLI
from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.dry_joints import NARROW
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

KINDS = {"shear": ("Blues", "mostly shear"), "tension": ("Reds", "mostly tension")}
"""What a crack may be led by: its colours, and how that is said."""
MOVED = {"shear": "mostly slid", "tension": "mostly opened"}
"""How that is said of joints of law `friction`, which have no damage by degrees."""
DRY = "#3a7d34"
"""The colour of joints of other laws without strength that slid or opened."""
CRUSHED = "#d01c8b"
"""The colour of joints that crushed: they closed for good."""
LEAST_SCALE = 1e-5
"""Openings (m) smaller than this one are drawn thin, as there is no larger one."""
THIN, THICK = 0.8, 3.8
"""Widths of a line in points: where the faces have hardly moved apart, and where they did by the scale of the
picture."""
WIDE_ENOUGH = 2.4
"""Points: at least so wide is what crushed, which closes by far less than other joints open."""


def scale_of(openings: np.ndarray) -> float:
    """The opening (m) that is drawn at full width: the largest of them, rounded up to one digit, but no less than
    LEAST_SCALE; 0 without any of NARROW."""
    largest = float(openings.max(initial=0.0))
    if largest < NARROW:
        return 0.0
    largest = max(largest, LEAST_SCALE)
    power = 10.0 ** np.floor(np.log10(largest))
    return float(power * np.ceil(largest / power * (1.0 - 1e-9)))


def widths(openings: np.ndarray, scale: float) -> np.ndarray:
    """Widths (points) of lines by the openings (m) of the cracks that they stand for."""
    fraction = np.clip(openings / scale, 0.0, 1.0) if scale > 0.0 else np.zeros(len(openings))
    return np.asarray(THIN + (THICK - THIN) * fraction)


def crack_widths(cracks: Any, scale: float) -> np.ndarray:
    """(n,) points, widths of the lines of cracks; what crushed is seen whatever opened beside it."""
    wide = widths(cracks.opening, scale)
    return np.where(cracks.crushed, np.maximum(wide, WIDE_ENOUGH), wide)


def drawing_order(cracks: Any) -> np.ndarray:
    """(n,) numbers of cracks as they are drawn, one above the other: by damage, and last what crushed."""
    return np.lexsort((cracks.damage, cracks.crushed))


def draw_cracks(
    axes: Any, result: "ResultData", lines: CrackLines, frame: Frame, camera: Camera, times: float, scale: float
) -> None:
    """Draw the lines where they stand in a frame whose displacements are drawn `times` larger."""
    from matplotlib.collections import LineCollection

    field = Deformation(BlockCorners(result.specimen.blocks), frame)
    pieces = camera.project(lines.displaced(result.joints, field, times))
    order = drawing_order(lines)
    colours = crack_colours(lines)
    axes.add_collection(
        LineCollection(
            list(pieces[order]),
            colors=colours[order],
            linewidths=crack_widths(lines, scale)[order],
            capstyle="round",
            zorder=3.0,
        )
    )


def crack_colours(cracks: Any) -> np.ndarray:
    """(n, 4) colours of cracks by their damage and by what leads; one for what moved without damage, one for what
    crushed."""
    from matplotlib.colors import to_rgba

    damage = cracks.damage
    damaged = np.where(cracks.tension_led[:, None], crack_map("Reds")(damage), crack_map("Blues")(damage))
    moved = np.where(cracks.dry[:, None], to_rgba(DRY), damaged)
    return np.where(cracks.crushed[:, None], to_rgba(CRUSHED), moved)


def crack_map(name: str) -> Any:
    """A sequential colour map without its palest third, which would not show on the blocks."""
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    return ListedColormap(colormaps[name](np.linspace(0.3, 0.95, 256)))


def kinds_of(cracks: Sequence[Any]) -> list[str]:
    """Which of KINDS there are among the cracks of some frames, "dry" where joints moved without damage, and "crushed"
    where some crushed."""
    if not cracks:
        return []
    names = ("tension_led", "dry", "crushed")
    led, dry, crushed = (np.concatenate([getattr(lines, name) for lines in cracks]) for name in names)
    cracked = ~dry & ~crushed
    there = {"shear": ~led & cracked, "tension": led & cracked, "dry": dry & ~crushed, "crushed": crushed}
    return [kind for kind, which in there.items() if which.any()]


def draw_scales(figure: Any, axes: list[Any], kinds: Sequence[str]) -> None:
    """Colour bars of damage, one for each kind of crack that there is."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    for name, word in (KINDS[kind] for kind in kinds if kind in KINDS):
        bar = ScalarMappable(Normalize(0.0, 1.0), crack_map(name))
        figure.colorbar(bar, ax=axes, label=f"damage, {word}", fraction=0.025, pad=0.01, aspect=30)


def crack_keys(scale: float, kinds: Sequence[str], dry: bool = False) -> list[Any]:
    """Entries of a legend: the kinds of cracks that there are, or of joints where all are `dry`, and what width stands
    for which opening."""
    from matplotlib.lines import Line2D

    keys = [
        Line2D(
            *([], []),
            color=crack_map(KINDS[kind][0])(0.9),
            linewidth=3.0,
            label=f"joint, {MOVED[kind]}" if dry else f"crack, {KINDS[kind][1]}",
        )
        for kind in reversed(kinds)
        if kind in KINDS
    ]
    if "dry" in kinds:
        keys.append(Line2D([], [], color=DRY, linewidth=3.0, label="moved without damage"))
    if "crushed" in kinds:
        keys.append(Line2D([], [], color=CRUSHED, linewidth=3.0, label="crushed"))
    if scale > 0.0:
        shown = np.array([NARROW, 0.5 * scale, scale])
        moved = "opened, slid or crushed" if "crushed" in kinds else "opened or slid"
        for opening, width in zip(shown, widths(shown, scale), strict=True):
            word = f"{moved} {opening * MILLI:.3g} mm" + (" (less is not drawn)" if opening == NARROW else "")
            keys.append(Line2D([], [], color="0.35", linewidth=width, label=word))
    return keys
