"""The TYPE of a set of blocks picks its loops; None (no such blocks) compiles to nothing; one version per threading."""

import sys
from collections.abc import Callable

from masonry.jit.compiler import inner, inner_parallel, jit, jit_parallel
from masonry.jit.extending import overload

_compiled: dict = {}


def _loop(body_class: type, name: str, compiler: Callable):
    """The loop `name` of the file in which a set of blocks is defined, as a compiler makes it."""
    key = body_class, name, compiler
    if key not in _compiled:
        _compiled[key] = compiler(getattr(sys.modules[body_class.__module__], name))
    return _compiled[key]


def _called_from_python(body, name: str, parallel):
    return _loop(type(body), name, jit if parallel is None else jit_parallel)


def _compiled_in(body, name: str, parallel):
    return _loop(body.instance_class, name, inner_parallel if "bool" in str(parallel) else inner)


def update_positions(parallel, body, dt, u):
    """First half of the step: advance the dofs by dt v, write the displacement of every point (rows of u)."""
    if body is not None:
        _called_from_python(body, "update_positions", parallel)(body, dt, u)


def move(parallel, body, dt, damping, loading, force, u):
    """Second half of the step: forces, damping, works, velocities; loading as in kinematics/motion.py."""
    if body is not None:
        _called_from_python(body, "move", parallel)(body, dt, damping, loading, force, u)


def _is_absent(numba_type) -> bool:
    return not hasattr(numba_type, "instance_class")


@overload(update_positions)
def _update_positions(parallel, body, dt, u):
    if _is_absent(body):
        return lambda parallel, body, dt, u: None
    loop = _compiled_in(body, "update_positions", parallel)
    return lambda parallel, body, dt, u: loop(body, dt, u)


@overload(move)
def _move(parallel, body, dt, damping, loading, force, u):
    if _is_absent(body):
        return lambda parallel, body, dt, damping, loading, force, u: None
    loop = _compiled_in(body, "move", parallel)
    return lambda parallel, body, dt, damping, loading, force, u: loop(body, dt, damping, loading, force, u)
