"""The frames of a result in a page: how blocks moved, what joints did, and the curve beside it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.movies.movie import paths_of
from masonry.movies.scene_3d import FIELDS, values_of
from masonry.pictures.crack_picture import largest_move, magnification, panel_title
from masonry.pictures.style import plain
from masonry.results.deformation import BlockCorners, Deformation
from masonry.rows.history import Frame
from masonry.viewing.buffers import Buffers
from masonry.viewing.joint_tiles import JointTiles

if TYPE_CHECKING:
    from masonry.results.data import ResultData

MOST = 60
"""Frames of a page, where nothing else is said."""
STOPS = 24
"""Colours of a map."""
LEAST_SHOWN = 1e-3
"""Fraction of the largest value of a field, up to which a contact point is left without colour."""


@dataclass(frozen=True)
class Field:
    """Of joints or of blocks: title with its unit, factor from SI, map of colours; largest value if known;
    `signed`: from minus to plus the largest; `everywhere`: small values are shown too, and of a whole joint the mean
    stands for all points, not the largest."""

    title: str
    factor: float
    colours: str
    largest: float | None = None
    signed: bool = False
    everywhere: bool = False


OF_JOINTS = {
    **{
        name: Field(shown.title, shown.factor, shown.colours, shown.range and shown.range[1])
        for name, shown in FIELDS.items()
        if name != "mode"
    },
    "crushing": Field("closed for good [mm]", 1e3, "RdPu"),
    "normal_stress": Field("normal stress [MPa], tension +", 1e-6, "coolwarm", signed=True, everywhere=True),
    "shear_stress": Field("shear stress [MPa]", 1e-6, "viridis", everywhere=True),
}
COMPRESSION = Field("largest compression in blocks [MPa]", 1e-6, "YlOrBr", everywhere=True)


def chosen_frames(frames: list[Frame], limit: int, keep: int | None) -> list[Frame]:
    """At most so many of them, evenly, the first, the last and number `keep` among them."""
    if len(frames) <= limit:
        return frames
    chosen = set(np.linspace(0, len(frames) - 1, limit).round().astype(int).tolist())
    return [frames[k] for k in sorted(chosen | ({keep} if keep is not None else set()))]


def frames_part(
    result: "ResultData", frames: list[Frame], tiles: JointTiles, origin: np.ndarray, into: Buffers
) -> dict[str, Any]:
    """Movements, fields with their ranges over all frames, words and the place on the curve of each frame."""
    corners = BlockCorners(result.specimen.blocks)
    values = {name: [_values(frame, name, tiles) for frame in frames] for name in OF_JOINTS}
    fields = [name for name in OF_JOINTS if any(map(np.any, values[name]))]
    size = float(np.ptp(result.specimen.blocks.points, axis=0).max())
    return {
        "scale": magnification(max(frames, key=largest_move), size),
        "list": [_frame(result, frame, corners, into) for frame in frames],
        "centre": into.add(corners.centre - origin),
        "meshed": into.add(_meshed(result), "u4"),
        "fields": [_field(name, OF_JOINTS[name], values[name], into) for name in fields],
        "block_fields": [_field("compression", COMPRESSION, [compression(frame.stress) for frame in frames], into)],
        "curve": _curve(result, frames),
    }


def compression(stress: np.ndarray) -> np.ndarray:
    """(B,) Pa, the largest compression of mean stresses (B, 6; xx yy zz yz xz xy), 0 where nothing is compressed."""
    xx, yy, zz, yz, xz, xy = np.nan_to_num(stress).T
    tensor = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=1).reshape(-1, 3, 3)
    return np.maximum(-np.linalg.eigvalsh(tensor)[:, 0], 0.0)


def middle_of(points: np.ndarray) -> np.ndarray:
    """(3,) of the box about points (n, 3): a page counts from there, in single precision."""
    return np.asarray(0.5 * (points.min(axis=0) + points.max(axis=0)))


def _meshed(result: "ResultData") -> np.ndarray:
    """(B,) 1 for blocks that deform in themselves, whose corners go their own ways."""
    tets = result.mesh
    return np.zeros(result.specimen.blocks.count) if tets is None else (np.diff(tets.tet_start) > 0).astype(int)


def _values(frame: Frame, name: str, tiles: JointTiles) -> np.ndarray:
    """(T,) in SI; 0 where a result has no such."""
    values = values_of(frame, name) if name in FIELDS else getattr(frame, name)
    values = np.zeros(len(frame.opening)) if values is None else np.nan_to_num(values)
    return tiles.mean(values) if OF_JOINTS[name].everywhere else tiles.largest(values)


def _frame(result: "ResultData", frame: Frame, corners: BlockCorners, into: Buffers) -> dict[str, Any]:
    field = Deformation(corners, frame)
    entry = {
        "words": panel_title(result, f"step {frame.step}", frame, 1.0).rpartition("\n")[0],
        "shift": into.add_rounded(field.at(np.arange(result.specimen.blocks.count), corners.centre, _no_nodes(result))),
        "gradient": into.add_rounded(field.gradient),
    }
    return entry | ({"corners": into.add_rounded(frame.corners)} if result.mesh is not None else {})


def _no_nodes(result: "ResultData") -> np.ndarray:
    return np.full(result.specimen.blocks.count, -1)


def _field(name: str, field: Field, values: list[np.ndarray], into: Buffers) -> dict[str, Any]:
    """Values of all frames, one after the other, and how they are coloured."""
    largest = field.largest or field.factor * max(
        float(np.abs(np.nan_to_num(array)).max(initial=0.0)) for array in values
    )
    return {
        "name": name,
        "title": field.title.replace("\n", ", "),
        "low": -largest if field.signed else 0.0,
        "high": largest or 1.0,
        "least": 0.0 if field.everywhere else LEAST_SHOWN * largest,
        "colours": _stops(field.colours, field.signed),
        "values": [into.add_rounded(field.factor * np.asarray(array)) for array in values],
    }


def _stops(name: str, signed: bool) -> list[str]:
    from matplotlib import colormaps
    from matplotlib.colors import to_hex

    from masonry.pictures.crack_style import crack_map

    colours = colormaps[name] if signed or name == "viridis" else crack_map(name)
    return [to_hex(colours(x)) for x in np.linspace(0.0, 1.0, STOPS)]


def _curve(result: "ResultData", frames: list[Frame]) -> dict[str, Any] | None:
    """Lines of the curve in the units of its axes, and for each line its place at each frame; None without rows."""
    if not len(result.history.rows.get("displacement", ())):
        return None
    lines, across, up = paths_of(result)
    return {
        "across": across.replace("$", ""),
        "up": up.replace("$", ""),
        "lines": [
            {
                "name": plain(line.name),
                "x": _rounded(line.across),
                "y": _rounded(line.up),
                "at": [max(int(np.searchsorted(line.steps, frame.step, side="right")) - 1, 0) for frame in frames],
            }
            for line in lines
        ],
    }


def _rounded(values: np.ndarray) -> list[float]:
    return [float(f"{x:.6g}") for x in np.nan_to_num(values).tolist()]
