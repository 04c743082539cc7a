"""Arrays of numbers in a page: one block of bytes, packed and as text, and where in it each array lies."""

import gzip
from base64 import b64encode
from typing import Any

import numpy as np

ALIGNED = 4
"""Bytes: an array begins at a multiple of them, as typed arrays of JavaScript do."""
LEVEL = 6
"""Of gzip."""
LARGEST = 32767
"""Whole number that stands for the largest value of a rounded array."""
KINDS = {"f4": np.float32, "u4": np.uint32, "i2": np.int16}


class Buffers:
    """Collects arrays; each is known by a place, a kind and, where it is rounded, the value of its unit."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._size = 0

    def add(self, values: np.ndarray, kind: str = "f4") -> dict[str, Any]:
        """An array as it is, in single precision ("f4") or as whole numbers ("u4")."""
        return self._put(np.ascontiguousarray(values, dtype=KINDS[kind]), kind)

    def add_rounded(self, values: np.ndarray) -> dict[str, Any]:
        """An array rounded to a fraction of 1/LARGEST of its largest value; what is not finite becomes 0."""
        known = np.nan_to_num(np.asarray(values, dtype=float), nan=0.0, posinf=0.0, neginf=0.0)
        unit = float(np.abs(known).max(initial=0.0)) / LARGEST or 1.0
        return self._put(np.rint(known / unit).astype(np.int16), "i2") | {"unit": unit}

    def text(self) -> str:
        """All of them, packed by gzip and written in the 64 letters of base64; the same arrays give the same text."""
        return b64encode(gzip.compress(b"".join(self._parts), LEVEL, mtime=0)).decode()

    def _put(self, array: np.ndarray, kind: str) -> dict[str, Any]:
        content = array.tobytes()
        entry = {"at": self._size, "count": int(array.size), "kind": kind}
        content += b"\0" * (-len(content) % ALIGNED)
        self._parts.append(content)
        self._size += len(content)
        return entry
