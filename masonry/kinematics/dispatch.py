"""The TYPE of a set of blocks picks its loops; None (no such blocks) compiles to nothing; one version per threading."""

import sys

from masonry.jit.compiler import jit, jit_parallel
from masonry.jit.extending import overload

_compiled: dict = {}


def _loop(body_class: type, name: str, parallel: bool):
    """The compiled loop `name` of the file in which a set of blocks is defined."""
    key = body_class, name, parallel
    if key not in _compiled:
        loop = getattr(sys.modules[body_class.__module__], name)
        _compiled[key] = (jit_parallel if parallel else jit)(loop)
    return _compiled[key]


def update_positions(parallel, body, dt, u):
    """First half of the step: advance the dofs by dt v, write the displacement of every point (rows of u)."""
    if body is not None:
        _loop(type(body), "update_positions", parallel is not None)(body, dt, u)


def move(parallel, body, dt, damping, loading, force, u):
    """Second half of the step: forces, damping, works, velocities; loading as in kinematics/motion.py."""
    if body is not None:
        loop = _loop(type(body), "move", parallel is not None)
        loop(body, dt, damping, loading, force, u)


def _is_absent(numba_type) -> bool:
    return not hasattr(numba_type, "instance_class")


@overload(update_positions)
def _update_positions(parallel, body, dt, u):
    if _is_absent(body):
        return lambda parallel, body, dt, u: None
    loop = _loop(body.instance_class, "update_positions", "bool" in str(parallel))
    return lambda parallel, body, dt, u: loop(body, dt, u)


@overload(move)
def _move(parallel, body, dt, damping, loading, force, u):
    if _is_absent(body):
        return lambda parallel, body, dt, damping, loading, force, u: None
    loop = _loop(body.instance_class, "move", "bool" in str(parallel))
    return lambda parallel, body, dt, damping, loading, force, u: loop(body, dt, damping, loading, force, u)
