"""All elements over the blocks of a specimen: each kind of them has a file of its own, and one entry here."""

from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Blocks
from masonry.pictures.camera import Camera
from masonry.pictures.hidden_surfaces import Piece
from masonry.pictures.overlays import bar_lines
from masonry.rows.history import Frame
from masonry.scene import Scene

if TYPE_CHECKING:
    from masonry.results.data import ResultData

KINDS = (bar_lines,)
"""Each draws those of a scene or of a run, and gives entries of a key of what occurs there."""


def draw_elements(axes: Any, scene: Scene, blocks: Blocks, camera: Camera, seen: list[Piece]) -> None:
    """Those of a scene; seen from a corner with the pieces that are seen, they are dashed where these hide them."""
    for kind in KINDS:
        kind.draw_in_scene(axes, scene, blocks, camera, seen)


def draw_elements_of(
    axes: Any, result: "ResultData", frame: Frame, camera: Camera, times: float, seen: list[Piece] | None = None
) -> None:
    """Those of a run where they are in a frame, displacements `times` larger."""
    for kind in KINDS:
        kind.draw_in_run(axes, result, frame, camera, times, seen)


def segments_of(scene: Scene) -> list[tuple[np.ndarray, str, str]]:
    """Ends (2, 3) m, words and colour of all that runs from point to point in a scene."""
    return [segment for kind in KINDS for segment in kind.segments_of(scene)]


def element_keys(scene: Scene) -> list[Any]:
    """Entries of a key of those of a scene."""
    return [key for kind in KINDS for key in kind.keys_of_scene(scene)]


def element_keys_of(result: "ResultData") -> list[Any]:
    """Entries of a key of those of a run."""
    return [key for kind in KINDS for key in kind.keys_of_run(result)]
