"""Numba's `overload` and `register_jitable`, for what is compiled into other functions alone.

Numba compiles a wrapper around each such function, for callers in C, that nothing here calls: a fifth of the time of
the first compilation of a scene.
"""

from collections.abc import Callable
from typing import Any

from numba import extending

from masonry.jit.linked_library import LinkedCompiler

INNER = {"no_cfunc_wrapper": True, "no_cpython_wrapper": True, "pipeline_class": LinkedCompiler}


def overload(function: Any, **options: Any) -> Callable[[Any], Any]:
    """As Numba's: the function that follows says by the types of its arguments what `function` is compiled to."""
    return extending.overload(function, jit_options=INNER, **options)


def register_jitable(function: Any = None, **options: Any) -> Any:
    """As Numba's: a Python function that compiled functions may call."""
    decorate = extending.register_jitable(**options | INNER)
    return decorate if function is None else decorate(function)
