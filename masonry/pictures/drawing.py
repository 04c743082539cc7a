"""Drawing of the frames of one result, seen by a camera; kinds: front.py, oblique.py, large/moved_blocks.py."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.pictures.camera import Camera
from masonry.pictures.thrust_line import ThrustLine
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData


class Drawing(ABC):
    """Draws the frames of one result. `thrust` is its thrust line, None where this drawing shows none."""

    result: "ResultData"
    camera: Camera
    thrust: ThrustLine | None = None

    @abstractmethod
    def cracks(self, frame: Frame) -> Any:
        """The contacts to draw; `opening` (n,) is how far their faces moved apart or along each other, m."""

    @abstractmethod
    def draw(self, axes: Any, frame: Frame, cracks: Any, times: float, scale: float) -> None:
        """Draw a frame with displacements `times` larger, its cracks and its thrust line; `scale` is the opening (m)
        of a line of full width."""

    def forces_at(self, frame: Frame, times: float) -> np.ndarray:
        """(J, 3) m, where the thrust line or its marks are drawn; not a number where nothing is."""
        return np.zeros((0, 3)) if self.thrust is None else self.thrust.displaced(self.result, frame, times)
