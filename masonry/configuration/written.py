"""Arrays that the steps, the guide and rows write in a model: the fields of these types, under the names that they have
in the arrays of bodies, of motion and of bonds. All else stays as it was made."""

from typing import Any, NamedTuple

import numpy as np

from masonry.elements.element import Elements
from masonry.model.large.meeting import Large
from masonry.model.model import Model
from masonry.patches.pairs import COLUMNS


class WrittenOfBodies(NamedTuple):
    """Of the bodies of a kind, None where they have none: motion, forces and works; the expected motion, which the
    guide writes; loads, which may vary; what turns, and what patches push."""

    q: np.ndarray | None
    v: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    inner: np.ndarray | None
    work: np.ndarray
    guess: np.ndarray | None
    load: np.ndarray | None
    change: np.ndarray | None
    frame: np.ndarray | None
    momentum: np.ndarray | None
    patches: np.ndarray | None
    shifted: np.ndarray | None


class WrittenOfMotion(NamedTuple):
    """Of BlockMotion, where some blocks deform: gathered of all kinds at each step, and looked at by rows and frames
    before the next one."""

    moved: np.ndarray
    frame: np.ndarray
    v: np.ndarray
    push: np.ndarray
    radius: np.ndarray
    dual: np.ndarray
    rate: np.ndarray
    strain: np.ndarray


class WrittenOfBonds(NamedTuple):
    """Of Bonds; those that retire are left out of runs."""

    u: np.ndarray
    force: np.ndarray
    apart: np.ndarray
    alive: np.ndarray
    runs: np.ndarray


class WrittenOfDashpots(NamedTuple):
    """Of Dashpots."""

    before: np.ndarray
    stress: np.ndarray
    taken: np.ndarray


class WrittenOfSearch(NamedTuple):
    """Of Search."""

    alive: np.ndarray
    built: np.ndarray
    skin: np.ndarray
    refusal: np.ndarray
    tally: np.ndarray


Arrays = dict[str, np.ndarray]


def written_arrays(model: Model, of_joints: Elements) -> Arrays:
    """By name, what is written in any model; what contacts remember once, whoever looks at it."""
    arrays: dict[str, np.ndarray | None] = {"u": model.contacts.u, "force": model.contacts.force}
    for kind, body in zip(model.layout.members, model.bodies, strict=True):
        if body is not None:
            arrays |= _fields(kind, WrittenOfBodies, body)
    if model.dashpots is not None:
        arrays |= _fields("dashpots", WrittenOfDashpots, model.dashpots)
    for element in (*of_joints, *model.elements):
        arrays = joined(arrays, {f"{element.name}.{name}": array for name, array in element.written().items()})
    for g, contacts in enumerate((model.state, *model.groups.states)):
        seen = {id(array) for array in arrays.values()}
        unseen = {f"contacts.{g}.{k}": array for k, array in enumerate(contacts) if id(array) not in seen}
        arrays = joined(arrays, unseen)
    return {name: array for name, array in arrays.items() if array is not None}


def written_in_large(model: Model, large: Large) -> Arrays:
    """Arrays that large displacement writes besides."""
    near = large.near
    arrays: dict[str, Any] = {"account": near.account, "area": model.contacts.area, "travel": near.motion.travel}
    arrays |= _fields("bonds", WrittenOfBonds, large.bonds) | _fields("search", WrittenOfSearch, near.search)
    if large.members is not None:
        arrays |= _fields("motion", WrittenOfMotion, near.motion) | {"rotations": large.bonds.frames}
    arrays |= {f"pairs.{name}": getattr(near.pairs, name) for name in ("number", *COLUMNS)}
    return arrays | {f"points.{name}": array for name, array in near.points._asdict().items() if array is not None}


def joined(arrays: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    """Both tables of arrays. Raises ValueError where a name stands in both: a checkpoint would keep one of the two."""
    if twice := sorted(arrays.keys() & more.keys()):
        raise ValueError(f"two parts of a model write '{twice[0]}': the name of an element is that of no other part")
    return arrays | more


def _fields(name: str, written: Any, arrays: Any) -> dict[str, np.ndarray | None]:
    return {f"{name}.{field}": getattr(arrays, field, None) for field in written._fields}
