"""Surfaces of others that come with the program: what they are, where they are from, and how they are imported."""

from importlib.resources import files
from pathlib import Path
from typing import NamedTuple


class DataSet(NamedTuple):
    """One of them: its name for `masonry import`, a title, its source and licence, the options that suit it, a word on
    what they stand for, and the view that shows it best."""

    name: str
    title: str
    source: str
    options: tuple[str, ...]
    why: str
    view: str = "iso"


COMPAS = "compas_dem, Block Research Group, ETH Zurich (MIT licence)"
STONES = "Rigid-Block-3D, Qianqing Wang, EPFL, 2025 (MIT licence)"
DATA_SETS = (
    DataSet(
        "wall.obj",
        "A wall of 38 stones in seven courses",
        COMPAS,
        ("--gap", "25 mm"),
        "Its head joints gape by 25 mm. They become joints half way between the stones.",
    ),
    DataSet(
        "dome.obj",
        "A dome of 90 voussoirs, open at its crown",
        COMPAS,
        ("--gap", "5 mm"),
        "Each face is there twice, and hardly any is flat. A joint is one plane, the mean of two triangles a side.",
    ),
    DataSet(
        "crossvault.obj",
        "A cross vault of 184 blocks on four feet",
        COMPAS,
        ("--unit", "25 mm", "--gap", "1 mm", "--tolerance", "1 mm"),
        "1 in the file is 25 mm, as in the examples of its makers. Its blocks overlap by up to 0.55 mm at the crown.",
    ),
    DataSet(
        "stones",
        "39 stones of a rubble wall",
        STONES,
        ("--up", "x", "--holes", "20 mm", "--gap", "40 mm", "--angle", "30 deg"),
        "The stones touch nowhere: mortar of 7 to 40 mm was between them, where dry joints are now. x is up.",
        "front",
    ),
)


def data_path(source: Path) -> Path:
    """Where a file or a folder is: where its name says, or among the data that come with the program."""
    if source.exists() or str(source) not in {data.name for data in DATA_SETS}:
        return source
    return Path(str(files("masonry").joinpath("scenes", "data", str(source))))
