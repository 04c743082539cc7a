"""HDF5 files with members of another kind: shapes, types, links, packed, virtual and claimed data, attributes."""

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

from verification.fuzz.inputs.odd import NUMBERS, SECRET, TEXTS, one_of

LARGE = 1 << 20
"""Bytes of an array that only claims to be there."""


def change(draw: Random, path: Path) -> None:
    """One to three members of the file changed in place."""
    import h5py

    (path.parent / "other.h5").unlink(missing_ok=True)
    with h5py.File(path.parent / "other.h5", "w") as other:
        other["x"] = np.arange(100.0)
    (path.parent / "raw.bin").write_text(SECRET * 50, encoding="utf-8")
    with h5py.File(path, "r+") as file:
        for _ in range(1 + draw.randrange(3)):
            names: list[str] = []
            file.visit(names.append)
            name = one_of(draw, names)
            if draw.random() < 0.15:
                _attribute(draw, file[name] if draw.random() < 0.7 else file)
            elif isinstance(file[name], h5py.Dataset):
                _array(draw, file, name)
            else:
                _member(draw, file, name)


def _array(draw: Random, file: Any, name: str) -> None:
    """A dataset with other content."""
    values = file[name][()] if file[name].nbytes < LARGE else None
    if not isinstance(values, np.ndarray) or values.dtype.kind not in "iuf" or draw.random() < 0.3:
        _member(draw, file, name)
        return
    made = one_of(draw, ARRAYS)(draw, values)
    del file[name]
    file[name] = made


def _at(draw: Random, values: np.ndarray, number: Any) -> np.ndarray:
    flat = values.astype(float if isinstance(number, float) else values.dtype).ravel()
    if len(flat):
        try:
            flat[draw.randrange(len(flat))] = number
        except OverflowError:
            flat[:] = 0
    return flat.reshape(values.shape)


ARRAYS: tuple[Callable[[Random, np.ndarray], Any], ...] = (
    lambda draw, v: v[:0],
    lambda draw, v: v[: len(v) // 2] if v.ndim else v,
    lambda draw, v: np.concatenate([v, v]) if v.ndim else v,
    lambda draw, v: v.ravel(),
    lambda draw, v: v[None],
    lambda draw, v: np.zeros(v.shape + (0,)),
    lambda draw, v: v.astype(one_of(draw, (">f8", "<f4", "<i2", "<u8", "<c16", "<f2", "?", "S8"))),
    lambda draw, v: v * one_of(draw, (-1.0, 0.0, 1e9, 1e300, float("nan"))),
    lambda draw, v: _at(draw, v, one_of(draw, [n for n in NUMBERS if abs(n) < 2**62 or isinstance(n, float)])),
    lambda draw, v: _at(draw, v, one_of(draw, (-1, 10**9, 0))),
    lambda draw, v: np.array([(1, 2.0)], dtype=[("a", "i4"), ("b", "f8")]),
    lambda draw, v: one_of(draw, TEXTS).replace("\0", "").encode("utf-8", "replace"),
    lambda draw, v: v[::-1],
    lambda draw, v: float(v.ravel()[0]) if v.size else 0.0,
)


PACKINGS: tuple[dict[str, Any], ...] = (
    {"compression": "lzf"},
    {"scaleoffset": 0},
    {"fletcher32": True},
    {"maxshape": (None,)},
)


def _member(draw: Random, file: Any, name: str) -> None:
    """Something of another kind under the same name."""
    import h5py

    shape = (one_of(draw, (10, 10**6, 10**9, 10**12)),)
    kind = draw.randrange(12)
    del file[name]
    if kind == 0:
        return
    if kind == 1:
        file[name] = h5py.SoftLink(one_of(draw, ("/", f"/{name}", "/nowhere", "/blocks", "/rows")))
    elif kind == 2:
        file[name] = h5py.ExternalLink(
            one_of(draw, ("other.h5", "a.blocks.h5", "history.h5", "/etc/passwd", "/dev/zero", "no")), "x"
        )
    elif kind == 3:
        layout = h5py.VirtualLayout(shape=shape, dtype="f8")
        layout[:100] = (
            h5py.VirtualSource("other.h5", "x", shape=(100,))[: min(100, shape[0])]
            if shape[0] >= 100
            else h5py.VirtualSource("other.h5", "x", shape=(100,))[: shape[0]]
        )
        file.create_virtual_dataset(name, layout, fillvalue=1.0)
    elif kind == 4:
        file.create_dataset(
            name, shape=(100,), dtype="f8", external=[(one_of(draw, ("raw.bin", "/etc/passwd", "/dev/zero")), 0, 800)]
        )
    elif kind == 5:
        file.create_dataset(
            name,
            shape=shape,
            dtype="f8",
            chunks=(min(one_of(draw, (10, 10**6)), *shape),),
            fillvalue=1.0,
            compression="gzip",
        )
    elif kind == 6:
        file.create_dataset(name, shape=shape, dtype=one_of(draw, ("f8", "i8", "u1")))
    elif kind == 7:
        file.create_dataset(
            name, data=np.zeros(4_000_000, dtype="u1"), chunks=(4_000_000,), compression="gzip", compression_opts=9
        )
    elif kind == 8:
        file.create_group(name)
    elif kind == 9:
        file[name] = np.dtype("f8")
    elif kind == 10:
        file.create_dataset(
            name,
            data=np.array([b"x", b"y"], dtype=object),
            dtype=h5py.string_dtype(),
        )
    else:
        file.create_dataset(
            name,
            data=np.arange(64),
            chunks=(8,),
            **one_of(draw, PACKINGS),
        )


def _attribute(draw: Random, member: Any) -> None:
    """An attribute lost, or of another kind."""
    names = list(member.attrs) or ["count"]
    name = one_of(draw, names)
    if draw.random() < 0.3:
        member.attrs.pop(name, None)
        return
    numbers = [n for n in NUMBERS if isinstance(n, float) or abs(n) < 2**63]
    text = one_of(draw, TEXTS).replace("\0", "").encode("utf-8", "replace").decode()[:1000]
    odd: tuple[Any, ...] = (
        one_of(draw, numbers),
        text,
        np.arange(3),
        [text, text],
        np.zeros((0,)),
        np.zeros((2, 2)),
        b"\xff\xfe",
    )
    member.attrs[name] = one_of(draw, odd)
