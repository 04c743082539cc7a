"""Result.show: the specimen in 3D by PyVista, off-screen where there is no display."""

from ctypes.util import find_library
from pathlib import Path
from typing import TYPE_CHECKING, Any

from geometry.files.atomic import whole_file
from geometry.operating_system import SYSTEM
from masonry.errors import SceneError, extra, nearest
from masonry.movies.scene_3d import FIELDS, Viewer
from masonry.pictures.camera import VIEWS
from masonry.pictures.crack_picture import magnification
from masonry.results.frame_choice import choose

if TYPE_CHECKING:
    from masonry.results.data import ResultData

WINDOW = (1200, 900)


def show(
    result: "ResultData",
    step: str | int | float = "peak",
    field: str = "opening",
    scale: float | None = None,
    view: str = "iso",
    screenshot: Path | str | None = None,
    everywhere: bool = False,
) -> None:
    """Show the specimen in a window, in a notebook, or in a file.

    step        "peak", "lowest", "last", "first", a number of a step, or a displacement: "-0.05 mm", or m as a float
    field       "opening", "slip", "damage", "damage_tension", "damage_shear", or "mode": damage, red where tension
                leads and blue where shear does
    scale       by how much displacements are drawn larger; by default so that they show
    view        "iso", "front", "back" or "side"
    screenshot  a .png file to write in place of a window; needs no display
    everywhere  colour the joints that are not damaged as well

    Raises SceneError for other words, without PyVista, and where there is neither display nor screenshot;
    GeometryError where the file cannot be written.
    """
    for name, word, known in (("field", field, tuple(FIELDS)), ("view", view, VIEWS)):
        if word not in known:
            raise SceneError(f"{name} '{word}'; {nearest(str(word), known)}")
    if screenshot is not None and Path(screenshot).suffix != ".png":
        raise SceneError(f"'{screenshot}': the screenshot is a .png file; nearest: '{Path(screenshot).stem}.png'")
    pyvista = _pyvista()
    chosen = choose(result, step)
    frames = result.history.frames
    number = next(k for k, frame in enumerate(frames) if frame is chosen.frame)
    off_screen = screenshot is not None or pyvista.OFF_SCREEN
    plotter = pyvista.Plotter(off_screen=off_screen, window_size=WINDOW)
    if not off_screen and not plotter.notebook and not SYSTEM.has_display():
        plotter.close()
        raise SceneError("there is no display to show it on; give a file: result.show(screenshot='wall.png')")
    viewer = Viewer(plotter, result, field, everywhere)
    viewer.set(number, chosen.name, scale if scale is not None else magnification(chosen.frame, viewer.size))
    viewer.look(view)
    if screenshot is not None:
        with whole_file(Path(screenshot)) as beside:
            plotter.screenshot(str(beside))
        plotter.close()
    elif plotter.notebook:
        plotter.show(jupyter_backend="static")
    else:
        if len(frames) > 1 and not off_screen:
            add_slider(plotter, viewer, number)
        plotter.show()


def add_slider(plotter: Any, viewer: Viewer, number: int) -> Any:
    """A slider through the frames, displacements by the same factor; returns it."""
    count = len(viewer.result.history.frames)

    def move(value: float) -> None:
        k = round(value)
        if k != viewer.number:
            viewer.set(k, f"frame {k + 1} of {count}", viewer.times)

    return plotter.add_slider_widget(
        move, [0, count - 1], value=number, title="frame", fmt="%.0f", pointa=(0.03, 0.1), pointb=(0.3, 0.1)
    )


def _pyvista() -> Any:
    if not SYSTEM.has_display() and not any(map(find_library, ("EGL", "OSMesa"))):  # VTK would end the process
        raise SceneError("there is no display, and no libEGL or libOSMesa to draw without: apt-get install libegl1")
    try:
        import pyvista
    except ImportError:
        raise SceneError(f"show() needs PyVista; {extra('view')}") from None
    if not SYSTEM.has_display():
        from vtkmodules.vtkCommonCore import vtkLogger

        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # it tries a display first, and warns of it
    return pyvista
