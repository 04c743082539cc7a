"""What the steps change in a model, to keep and to put back; and a fingerprint of all the rest."""

import hashlib
from collections.abc import Iterator
from typing import Any

import numpy as np

from masonry.configuration.energy import present
from masonry.configuration.room import make_room_for
from masonry.model.model import Model
from masonry.patches.pairs import COLUMNS
from masonry.runtime.state import Damaged, add_array

CHANGED = ("q", "v", "contact", "hold", "inner", "work", "guess", "load", "change")
"""Arrays of the bodies that a step writes; the expected motion, which the guide does; and loads, which may vary."""


GATHERED = ("moved", "frame", "v", "push", "radius", "dual", "rate", "strain")
"""Arrays of Motion that are written at each step where some blocks deform."""


def changing(model: Model) -> dict[str, np.ndarray]:
    """By name, each array that a step or the guide writes; what contacts remember once, whoever looks at it."""
    found: dict[str, np.ndarray | None] = {"u": model.contacts.u, "force": model.contacts.force}
    for kind, body in present(model):
        found |= {f"{kind}.{name}": getattr(body, name, None) for name in CHANGED}
    for g, contacts in enumerate((model.state, *model.groups.states)):
        seen = {id(array) for array in found.values()}
        found |= {f"contacts.{g}.{k}": array for k, array in enumerate(contacts) if id(array) not in seen}
    if model.large is not None:
        found |= large_arrays(model)
    return {name: array for name, array in found.items() if array is not None}


def large_arrays(model: Model) -> dict[str, np.ndarray | None]:
    """What large displacement changes besides. What is gathered of all kinds at each step is kept too, as rows and
    frames look at it before the next one."""
    large = model.large
    assert large is not None
    near = large.near
    found: dict[str, np.ndarray | None] = {"account": near.account, "bonded": near.search.alive}
    for kind, body in present(model):
        found |= {f"{kind}.{name}": getattr(body, name, None) for name in ("frame", "momentum", "patches")}
    if large.members is not None:
        found |= {f"motion.{name}": getattr(near.motion, name) for name in GATHERED} | {"rotations": large.bonds.frames}
    found |= {"apart": large.bonds.apart, "bond_u": large.bonds.u, "bond_force": large.bonds.force}
    found |= {"area": model.contacts.area, "alive": large.bonds.alive}
    found |= {"travel": near.motion.travel, "built": near.search.built}
    found |= {"refusal": near.search.refusal, "tally": near.search.tally, "skin": near.search.skin}
    found |= {f"pairs.{name}": getattr(near.pairs, name) for name in ("number", *COLUMNS)}
    return found | {f"points.{name}": array for name, array in near.points._asdict().items()}


def state(model: Model) -> dict[str, np.ndarray]:
    """Copies of what changes."""
    return {name: array.copy() for name, array in changing(model).items()}


def restore(model: Model, saved: dict[str, np.ndarray]) -> None:
    """Put it back where it was, so that nothing moves in memory. Raises Damaged where it is of another model."""
    make_room_for(model, saved)
    arrays = changing(model)
    if arrays.keys() != saved.keys() or any(arrays[name].shape != np.shape(saved[name]) for name in arrays):
        raise Damaged("its arrays are not those of this model")
    for name, array in arrays.items():
        array[...] = saved[name]


def fingerprint(model: Model) -> str:
    """Hash (hex) of all that no step changes: the same before the first step and after the last."""
    digest = hashlib.blake2b(digest_size=16)
    moving = {id(array) for array in changing(model).values()}
    fixed = model.groups, model.contacts, model.bodies, model.drives, model.supports, model.masses, model.dt
    for value in _leaves(fixed):
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
