"""How a curve of another package's law comes into the step: as it stands where it can be compiled for lanes, else lane
by lane, as the function of single numbers that it is.
"""

import sys
from collections.abc import Callable
from functools import cache
from types import FunctionType, ModuleType
from typing import Any

from numba import njit
from numba.core.errors import NumbaError
from numba.extending import register_jitable

from masonry.errors import SceneError
from masonry.jit.sources import is_ours
from masonry.simd.each import by_lane, single, width_in

Curve = Callable[..., Any]


def fitting(curve: Any, shape: Any, kinds: tuple[Any, ...]) -> tuple[Curve | None, Curve | None]:
    """(the curve itself, None), or (None, a function of the tuple of its arguments that calls it lane by lane).

    shape  Numba's type of the law's NamedTuple
    kinds  Numba's types of all arguments, lanes or numbers
    Raises SceneError for a curve that cannot be compiled for single numbers either.
    """
    if is_ours(shape.instance_class.__module__):
        return curve, None
    curve = getattr(curve, "py_func", curve)
    _let_in(sys.modules[curve.__module__])
    if _refusal(curve, kinds) is None:
        return curve, None
    width = width_in(kinds)
    refused = _refusal(curve, tuple(single(kind) for kind in kinds))
    if width is None or refused is not None:
        raise SceneError(f"{curve.__module__}.{curve.__name__} cannot be compiled by Numba: {refused}")
    return None, by_lane(curve, width)


def _refusal(curve: Curve, kinds: tuple[Any, ...]) -> str | None:
    """Why a function cannot be compiled for some types, or None where it can."""
    try:
        njit(error_model="numpy")(curve).compile(kinds)
    except NumbaError as error:
        said = [line.strip() for line in str(error).splitlines() if line.strip()]
        return " ".join(line for line in said if not line.startswith(("Failed in", "During:", "File ")))[:400]
    return None


@cache
def _let_in(module: ModuleType) -> None:
    """Let compiled code call the functions of a module; once for each."""
    for function in vars(module).values():
        if isinstance(function, FunctionType) and function.__module__ == module.__name__:
            register_jitable(function)
