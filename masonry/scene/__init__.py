"""Scenes: files and packaged ones, checked and in SI, and back to TOML that gives the same scene.

`checked_scene.py` makes a `Scene`; `source.py` knows where raw values stand.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from masonry.scene.checked_scene import Scene, changed, load, to_toml
    from masonry.scene.source import packaged, titles

__all__ = ["Scene", "changed", "load", "packaged", "titles", "to_toml"]


def __getattr__(name: str) -> Any:
    """Looked up when it is asked for: what checks a scene brings pydantic and numpy with it, which the list of the
    packaged scenes does not need."""
    if name not in __all__:
        raise AttributeError(f"module 'masonry.scene' has no attribute '{name}'")
    module = "masonry.scene.source" if name in ("packaged", "titles") else "masonry.scene.checked_scene"
    return getattr(import_module(module), name)
