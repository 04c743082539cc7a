"""A surface as it stands in a file: corners and polygons, flat or not, closed or not."""

from typing import NamedTuple

import numpy as np


class Surface(NamedTuple):
    """name, "" where the file has none; points (P, 3) in the file's unit; faces, each 3 or more numbers into points."""

    name: str
    points: np.ndarray
    faces: list[np.ndarray]
