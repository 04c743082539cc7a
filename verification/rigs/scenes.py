"""The scenes of the verification as files that `masonry run` takes too."""

from pathlib import Path

FOLDER = Path(__file__).parents[1] / "scenes"


def path_of(name: str) -> Path:
    """The file of a scene."""
    return FOLDER / f"{name}.toml"
