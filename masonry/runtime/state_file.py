"""State to keep: attributes by name; and a tree of plain values and arrays in one file that tells whether it is whole.

The file is an .npz without pickles, with a checksum of all."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Protocol

import numpy as np

State = dict[str, Any]
"""By name: numbers, words, bools, None, arrays, lists of these, and tables of the same kind."""


def attributes(thing: object, names: Iterable[str]) -> State:
    """Present values of these attributes, by name."""
    return {name: getattr(thing, name) for name in names}


def load_attributes(thing: object, names: Iterable[str], state: State) -> None:
    """Make them what they were."""
    for name in names:
        setattr(thing, name, state[name])


class Remembers(Protocol):
    """Object with a memory from one chunk of steps to the next: a snapshot of it, and back."""

    def state(self) -> State: ...

    def restore(self, state: State) -> None: ...


class Remembering:
    """Remembers attributes by name (REMEMBERED), and parts that remember something themselves."""

    REMEMBERED: tuple[str, ...] = ()

    def parts(self) -> Mapping[str, Remembers]:
        """By the name under which a snapshot keeps them."""
        return {}

    def state(self) -> State:
        """All that it remembers."""
        return {**attributes(self, self.REMEMBERED), **{name: part.state() for name, part in self.parts().items()}}

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, self.REMEMBERED, state)
        for name, part in self.parts().items():
            part.restore(state[name])


FORMAT = "masonry state 1"


class Damaged(ValueError):
    """A file that does not hold what was written to it."""


def write(path: Path, state: State) -> None:
    """Write a tree; a number of numpy's comes back as such. Raises TypeError for what is neither plain nor an array."""
    arrays: list[np.ndarray] = []
    tree = json.dumps(_plain(state, arrays)).encode()
    content: dict[str, Any] = {f"a{n}": array for n, array in enumerate(arrays)}
    content |= {"tree": np.frombuffer(tree, np.uint8), "sum": np.frombuffer(_sum(tree, arrays), np.uint8)}
    with open(path, "wb") as file:
        np.savez(file, **content)


def read(path: Path) -> State:
    """The tree that `write` wrote, its lists as lists. Raises Damaged where one bit differs, OSError where none can be
    read."""
    try:
        with np.load(path, allow_pickle=False) as file:
            tree = file["tree"].tobytes()
            arrays = [file[f"a{n}"] for n in range(len(file.files) - 2)]
            if file["sum"].tobytes() != _sum(tree, arrays):
                raise Damaged("its checksum does not fit")
            state = _whole(json.loads(tree), arrays)
    except (Damaged, OSError):
        raise
    except Exception as error:  # whatever numpy, zipfile and json say of broken bytes
        raise Damaged(f"{type(error).__name__}: {str(error)[:200]}") from None
    if not isinstance(state, dict):
        raise Damaged("it holds no table")
    return state


def _sum(tree: bytes, arrays: list[np.ndarray]) -> bytes:
    digest = hashlib.blake2b(FORMAT.encode(), digest_size=32)
    digest.update(tree)
    for array in arrays:
        add_array(digest, array)
    return digest.digest()


def add_array(digest: Any, array: np.ndarray) -> None:
    """Add type, shape and numbers of an array to a hash, however it lies in memory."""
    digest.update(f"{array.dtype.str}{array.shape}".encode())
    digest.update(np.ascontiguousarray(array).data)


def _plain(value: Any, arrays: list[np.ndarray]) -> Any:
    """The value for JSON; arrays go to the list, and leave their number."""
    if isinstance(value, np.ndarray | np.generic):
        array = np.asarray(value, order="C")
        if array.dtype.hasobject:
            raise TypeError("an array of objects cannot be kept")
        arrays.append(array)
        return {"array": len(arrays) - 1}
    if isinstance(value, dict):
        if not all(isinstance(key, str) for key in value):
            raise TypeError("a table is kept by words")
        return {"table": {key: _plain(entry, arrays) for key, entry in value.items()}}
    if isinstance(value, list | tuple):
        return [_plain(entry, arrays) for entry in value]
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"{type(value).__name__} cannot be kept")


def _whole(value: Any, arrays: list[np.ndarray]) -> Any:
    if isinstance(value, list):
        return [_whole(entry, arrays) for entry in value]
    if not isinstance(value, dict):
        return value
    if "array" in value:
        return arrays[value["array"]][()]
    return {key: _whole(entry, arrays) for key, entry in value["table"].items()}
