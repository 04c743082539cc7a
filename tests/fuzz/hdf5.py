"""HDF5 files with members of another kind: shapes, types, links, packed, virtual and claimed data, attributes."""

import io
from collections.abc import Callable
from typing import Any

import h5py
import numpy as np
from hypothesis import strategies as st

from tests.fuzz.odd import NUMBERS, TEXTS, Draw, below, chance, pick

LARGE = 1 << 20
"""Bytes of an array that only claims to be there."""
SHORT_TEXTS = [text.replace("\0", "").encode("utf-8", "replace")[:1000] for text in TEXTS]
FITTING = [number for number in NUMBERS if isinstance(number, float) or abs(number) < 2**62]
TYPES = (">f8", "<f4", "<i2", "<u8", "<c16", "<f2", "?", "S8")
LINKS = ("other.h5", "a.blocks.h5", "history.h5", "/etc/passwd", "/dev/zero", "no")
PACKINGS: tuple[dict[str, Any], ...] = (
    *({"compression": "lzf"}, {"scaleoffset": 0}, {"fletcher32": True}, {"maxshape": (None,)}),
)


def changed_hdf5(draw: Draw, content: bytes) -> bytes:
    """One to three members of the file exchanged."""
    changed = io.BytesIO(content)
    with h5py.File(changed, "r+") as file:
        for _ in range(draw(st.integers(1, 3))):
            names: list[str] = []
            file.visit(names.append)
            name = pick(draw, names)
            if chance(draw, 15):
                _attribute(draw, file[name] if chance(draw, 70) else file)
            elif isinstance(file[name], h5py.Dataset) and file[name].nbytes < LARGE and chance(draw, 70):
                _array(draw, file, name)
            else:
                _member(draw, file, name)
    return changed.getvalue()


def _array(draw: Draw, file: Any, name: str) -> None:
    """A dataset with other content."""
    values = file[name][()]
    if not isinstance(values, np.ndarray) or values.dtype.kind not in "iuf":
        values = np.zeros(3)
    with np.errstate(all="ignore"):
        made = pick(draw, ARRAYS)(draw, values)
    del file[name]
    file[name] = made


def _at(draw: Draw, values: np.ndarray, number: Any) -> np.ndarray:
    flat = values.astype(float if isinstance(number, float) else values.dtype).ravel()
    if len(flat):
        try:
            flat[below(draw, len(flat))] = number
        except OverflowError:
            flat[:] = 0
    return flat.reshape(values.shape)


ARRAYS: tuple[Callable[[Draw, np.ndarray], Any], ...] = (
    lambda draw, v: v[:0] if v.ndim else v,
    lambda draw, v: v[: len(v) // 2] if v.ndim else v,
    lambda draw, v: np.concatenate([v, v]) if v.ndim else v,
    lambda draw, v: v.ravel(),
    lambda draw, v: v[None],
    lambda draw, v: np.zeros((*v.shape, 0)),
    lambda draw, v: v.astype(pick(draw, TYPES)),
    lambda draw, v: v * pick(draw, (-1.0, 0.0, 1e9, 1e300, float("nan"))),
    lambda draw, v: _at(draw, v, pick(draw, FITTING)),
    lambda draw, v: _at(draw, v, pick(draw, (-1, 10**9, 0))),
    lambda draw, v: np.array([(1, 2.0)], dtype=[("a", "i4"), ("b", "f8")]),
    lambda draw, v: pick(draw, SHORT_TEXTS),
    lambda draw, v: v[::-1] if v.ndim else v,
    lambda draw, v: float(v.ravel()[0]) if v.size else 0.0,
)


def _member(draw: Draw, file: Any, name: str) -> None:
    """Something of another kind under the same name, or nothing."""
    del file[name]
    pick(draw, MEMBERS)(draw, file, name, (pick(draw, (10, 10**6, 10**9, 10**12)),))


def _virtual(draw: Draw, file: Any, name: str, shape: tuple[int]) -> None:
    layout = h5py.VirtualLayout(shape=shape, dtype="f8")
    layout[: min(100, *shape)] = h5py.VirtualSource("other.h5", "x", shape=(100,))[: min(100, *shape)]
    file.create_virtual_dataset(name, layout, fillvalue=1.0)


def _outside(draw: Draw, file: Any, name: str, shape: tuple[int]) -> None:
    place = pick(draw, ("raw.bin", "/etc/passwd", "/dev/zero"))
    file.create_dataset(name, shape=(100,), dtype="f8", external=[(place, 0, 800)])


def _packed(draw: Draw, file: Any, name: str, shape: tuple[int]) -> None:
    pieces = (min(pick(draw, (10, 10**6)), *shape),)
    file.create_dataset(name, shape=shape, dtype="f8", chunks=pieces, fillvalue=1.0, compression="gzip")


def _bomb(draw: Draw, file: Any, name: str, shape: tuple[int]) -> None:
    file.create_dataset(name, data=np.zeros(4_000_000, dtype="u1"), chunks=(4_000_000,), compression="gzip")


MEMBERS: tuple[Callable[[Draw, Any, str, tuple[int]], Any], ...] = (
    lambda draw, file, name, shape: None,
    lambda draw, file, name, shape: file.update(
        {name: h5py.SoftLink(pick(draw, ("/", f"/{name}", "/nowhere", "/blocks", "/rows")))}
    ),
    lambda draw, file, name, shape: file.update({name: h5py.ExternalLink(pick(draw, LINKS), "x")}),
    *(_virtual, _outside, _packed, _bomb),
    lambda draw, file, name, shape: file.create_dataset(name, shape=shape, dtype=pick(draw, ("f8", "i8", "u1"))),
    lambda draw, file, name, shape: file.create_group(name),
    lambda draw, file, name, shape: file.update({name: np.dtype("f8")}),
    lambda draw, file, name, shape: file.create_dataset(name, data=["x", "y"], dtype=h5py.string_dtype()),
    lambda draw, file, name, shape: file.create_dataset(name, data=np.arange(64), chunks=(8,), **pick(draw, PACKINGS)),
)


def _attribute(draw: Draw, member: Any) -> None:
    """An attribute lost, or of another kind."""
    name = pick(draw, list(member.attrs) or ["count"])
    if chance(draw, 30):
        member.attrs.pop(name, None)
        return
    text = pick(draw, SHORT_TEXTS).decode("utf-8", "ignore")
    odd = (pick(draw, FITTING), text, np.arange(3), [text, text], np.zeros((0,)), np.zeros((2, 2)), b"\xff\xfe")
    member.attrs[name] = pick(draw, odd)
