"""State that the steps change in a model, to keep and to put back; and a fingerprint of all the rest."""

import hashlib
from collections.abc import Iterator
from typing import Any

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.model.model import Model
from masonry.runtime.state_file import Damaged, add_array


def state(model: Model) -> dict[str, np.ndarray]:
    """Copies of what changes."""
    return {name: array.copy() for name, array in configuration_of(model).written().items()}


def restore(model: Model, saved: dict[str, np.ndarray]) -> None:
    """Put it back where it was, so that nothing moves in memory. Raises Damaged where it is of another model."""
    configuration = configuration_of(model)
    configuration.make_room_for(saved)
    arrays = configuration.written()
    if arrays.keys() != saved.keys() or any(arrays[name].shape != np.shape(saved[name]) for name in arrays):
        raise Damaged("its arrays are not those of this model")
    for name, array in arrays.items():
        array[...] = saved[name]


def fingerprint(model: Model) -> str:
    """Hash (hex) of all that no step changes: the same before the first step and after the last."""
    digest = hashlib.blake2b(digest_size=16)
    moving = {id(array) for array in configuration_of(model).written().values()}
    fixed = model.groups, model.contacts, model.bodies, model.drives, model.supports, model.masses, model.dt
    for value in _leaves((*fixed, *(one for element in model.elements if len(one := element.constants())))):
        if id(value) in moving:
            continue
        if isinstance(value, np.ndarray):
            add_array(digest, value)
        else:
            digest.update(repr(value).encode())
    return digest.hexdigest()


def _leaves(value: Any) -> Iterator[Any]:
    """Every array and number of nested tuples and tables."""
    if isinstance(value, dict):
        for key, entry in value.items():
            yield key
            yield from _leaves(entry)
    elif isinstance(value, tuple):
        yield type(value).__name__
        for entry in value:
            yield from _leaves(entry)
    else:
        yield value
