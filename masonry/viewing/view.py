"""A model or a result as a page to look at in space: `masonry view`, `masonry.view`."""

from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.files.atomic import whole_file
from masonry.assembly.assemble import Fabric, fabric_of
from masonry.errors import SceneError
from masonry.judgement.sentence import trust
from masonry.pictures.overlays.element_lines import segments_of
from masonry.results.data import ResultData
from masonry.runtime.named_file import require_free
from masonry.runtime.text_files import toml_of
from masonry.scene import Scene, load, to_toml
from masonry.viewing.buffers import Buffers
from masonry.viewing.frames_part import MOST, chosen_frames, frames_part, middle_of
from masonry.viewing.joint_tiles import JointTiles
from masonry.viewing.loads_part import loads_part
from masonry.viewing.model_part import blocks_part, joints_part, words_of
from masonry.viewing.page import page_text, require_page

IN_NOTEBOOK = 620
"""Height of a view in a notebook, pixels."""


@dataclass(frozen=True, repr=False)
class PageView:
    """A page of HTML with a model or a result in space; a notebook shows it.

    title  of the scene;  text  the whole page
    """

    title: str
    text: str

    def save(self, path: Path | str, overwrite: bool = False) -> Path:
        """Write it, whole or not at all; returns the path. Raises SceneError for another suffix than .html, and where a
        file stands there that we did not write (unless `overwrite`); GeometryError where it cannot be written."""
        path = Path(path)
        require_page(path)
        require_free(path, overwrite)
        with whole_file(path) as beside:
            beside.write_text(self.text, encoding="utf-8", newline="\n")
        return path

    def __repr__(self) -> str:
        return f"View: {self.title}, {len(self.text) / 1e6:.2g} MB of HTML; .save('view.html') writes it"

    def _repr_html_(self) -> str:
        style = f"width: 100%; height: {IN_NOTEBOOK}px; border: 1px solid #ddd"
        return f'<iframe style="{style}" srcdoc="{escape(self.text)}"></iframe>'


def view_of_scene(scene: Scene) -> PageView:
    """The model of a scene before it is run: blocks, joints, supports, loads, bars. Raises SceneError."""
    fabric = fabric_of(scene)
    buffers, origin, tiles = Buffers(), middle_of(fabric.specimen.blocks.points), JointTiles.of(fabric.joints)
    of_joints = tiles, fabric.group, fabric.contact_groups
    content = _specimen(fabric.specimen, *of_joints, scene.is_large, origin, buffers)
    content |= _acting(scene, fabric, origin, buffers) | {"words": words_of(toml_of(to_toml(scene), "scene"))}
    return _view(scene.title or scene.name, "", content, buffers)


def view_of_result(result: ResultData, frames: int = MOST) -> PageView:
    """A result: at most so many frames, the curve beside them. Raises SceneError where it has no frames, and for fewer
    than two."""
    if frames < 2:
        raise SceneError(f"{frames} frames: 2 or more")
    frames_of_run = result.history.frames
    if not frames_of_run:
        raise SceneError("this result has no frames: its run ended before there was one; there is nothing to show")
    buffers, origin, tiles = Buffers(), middle_of(result.specimen.blocks.points), JointTiles.of(result.joints)
    of_joints = tiles, result.joint_group, result.joint_groups
    content = _specimen(result.specimen, *of_joints, result.is_large, origin, buffers)
    content |= _acting_in(result, origin, buffers) | {"words": words_of(result.scene_table)}
    content["result"] = frames_part(result, chosen_frames(frames_of_run, frames, _peak(result)), tiles, origin, buffers)
    return _view(result.title, trust(result.summary), content, buffers)


def _view(title: str, verdict: str, content: dict[str, Any], buffers: Buffers) -> PageView:
    return PageView(title, page_text(title, {"title": title, "verdict": verdict} | content, buffers.text()))


def _specimen(
    specimen: Specimen,
    tiles: JointTiles,
    group: np.ndarray,
    groups: tuple[str, ...],
    parts: bool,
    origin: np.ndarray,
    buffers: Buffers,
) -> dict[str, Any]:
    return {
        "origin": origin.tolist(),
        "blocks": blocks_part(specimen, tiles.joints, origin, parts, buffers),
        "joints": joints_part(tiles, group, groups, origin, buffers),
    }


def _acting(scene: Scene, fabric: Fabric, origin: np.ndarray, buffers: Buffers) -> dict[str, Any]:
    return {"loads": loads_part(scene, fabric, origin, buffers), "segments": _segments(scene, origin)}


def _segments(scene: Scene, origin: np.ndarray) -> list[dict[str, Any]]:
    """Ends, words and colour of what runs from point to point beside the blocks."""
    return [
        {"ends": (ends - origin).tolist(), "words": words, "colour": colour}
        for ends, words, colour in segments_of(scene)
    ]


def _acting_in(result: ResultData, origin: np.ndarray, buffers: Buffers) -> dict[str, Any]:
    """Supports and loads in the scene of a result; nothing where its files are gone."""
    try:
        scene = load(result.scene_table)
        fabric = fabric_of(scene)
        if fabric.specimen.blocks.count != result.specimen.blocks.count:
            return {"loads": [], "segments": []}
        return _acting(scene, fabric, origin, buffers)
    except (SceneError, GeometryError):
        return {"loads": [], "segments": []}


def _peak(result: ResultData) -> int | None:
    """Number of the frame at the peak; None where nothing is driven."""
    if not result.has_drive:
        return None
    return int(np.argmin([abs(frame.displacement - result.peak.displacement) for frame in result.history.frames]))
