"""An open gmsh for as long as it is needed. The only file that imports gmsh."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from geometry.blocks import GeometryError


@contextmanager
def gmsh_model(options: dict[str, float]) -> Iterator[Any]:
    """An open gmsh, silent and on one thread, with an empty model and these options; leaves it as it was found."""
    try:
        import gmsh
    except OSError as error:
        raise GeometryError(
            f"this needs gmsh, and gmsh needs system libraries that are missing here ({error}); on Debian: "
            "apt-get install libgl1 libglu1-mesa libxrender1 libxcursor1 libxft2 libxinerama1 libfontconfig1 libgomp1"
        ) from error
    except ImportError as error:
        raise GeometryError(f"this needs gmsh, which is not installed ({error}); pip install gmsh") from error
    found_running = bool(gmsh.isInitialized())
    if not found_running:
        gmsh.initialize(readConfigFiles=False, interruptible=False)
    options = {"General.Terminal": 0, "General.NumThreads": 1, **options}
    before = {name: gmsh.option.getNumber(name) for name in options}
    try:
        for name, value in options.items():
            gmsh.option.setNumber(name, value)
        gmsh.model.add("blocks")
        try:
            yield gmsh
        finally:
            gmsh.model.remove()
    finally:
        for name, value in before.items():
            gmsh.option.setNumber(name, value)
        if not found_running:
            gmsh.finalize()
