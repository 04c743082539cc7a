"""The largest compression of the points of patches at the rows so far."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View


@dataclass(frozen=True)
class PatchCompression:
    """The largest compression (R,) Pa of a point of patches, by row of the rules."""

    largest: np.ndarray


class PressedPatches(Observer):
    """pressed (R,) Pa, by row of the rules."""

    REMEMBERED = ("pressed",)

    def __init__(self, model: Model) -> None:
        self.pressed = configuration_of(model).patches.compressions()

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        np.maximum(self.pressed, configuration_of(model).patches.compressions(), out=self.pressed)
        return {}

    def records(self) -> list[Any]:
        return [PatchCompression(self.pressed)]
