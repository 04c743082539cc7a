"""Contact laws: equations only, a file each. `law_dispatch.py` lets them into the step; building/ checks
numbers.

Laws of other packages come in by `building/plugins.py`, and import what they need from here.
"""

from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from masonry.laws.snap_back import Refusal
    from masonry.simd import any_lane, filled, maximum, minimum, where

__all__ = ["Refusal", "any_lane", "filled", "law_names", "maximum", "minimum", "where"]


@cache
def law_names() -> tuple[str, ...]:
    """Every law of ours: a file of this folder that names its PARAMETERS. Reads the folder, imports nothing."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    return tuple(file.stem for file in files if "\nPARAMETERS" in file.read_text(encoding="utf-8"))


def __getattr__(name: str) -> Any:
    """Names that authors of laws import, loaded on demand: the names of laws must not load the compiler."""
    if name not in __all__:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(import_module("masonry.laws.snap_back" if name == "Refusal" else "masonry.simd"), name)
