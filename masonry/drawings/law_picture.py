"""The portrait of a law as a picture: traction against separation, shear against slip, energies dissipated; and where
crushing is modelled, compression against closing and the surface of yield."""

from pathlib import Path
from typing import Any

from geometry.files.atomic import whole_file
from masonry.drawings.crushing_portrait import CrushingPortrait
from masonry.drawings.law_portrait import Portrait
from masonry.pictures.style import MEGA, MILLI, plain, write_picture
from masonry.runtime.named_file import require_picture

COLOURS = ("#4a90c2", "#1f3b5c", "#b2182b")
FRACTURE, FRICTION = "#d7301f", "#e07b00"


def draw_law(name: str, portrait: Portrait, path: Path) -> Path:
    """Write the picture (.png, .pdf or .svg), whole or not at all; returns the path. Raises SceneError where it
    cannot be written."""
    require_picture(path, "--plot")
    with whole_file(path) as beside:
        write_picture(law_figure(name, portrait), beside)
    return path


def law_figure(name: str, portrait: Portrait) -> Any:
    """A matplotlib figure: curves above, energies below; tension to the left, shear beside it, to the right crushing
    with the surface of yield, where it is modelled."""
    from matplotlib.figure import Figure

    crushes = portrait.crushing
    figure = Figure(figsize=(8.5 if crushes is None else 12.5, 6.5), layout="constrained")
    panels = figure.subplots(2, 2 if crushes is None else 3, height_ratios=[3, 2])
    for column in (0, 1):
        panels[0, column].sharex(panels[1, column])
        panels[0, column].tick_params(labelbottom=False)
    figure.suptitle(plain(f"law {name}"), fontsize=13)
    for axes in panels.flat:
        axes.grid(color="0.9", linewidth=0.8)
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)
    _draw_tension(panels[0, 0], panels[1, 0], portrait)
    _draw_shear(panels[0, 1], panels[1, 1], portrait)
    if crushes is not None:
        _draw_crushing(panels[0, 2], panels[1, 2], crushes)
    return figure


def _draw_tension(curve: Any, energies: Any, portrait: Portrait) -> None:
    path = portrait.tension
    curve.set_title("opened, closed until the faces press, opened again", fontsize=10, color="0.3")
    curve.plot(path.opening * MILLI, path.sigma * MEGA, color=COLOURS[1], linewidth=1.8)
    curve.axhline(0.0, color="0.5", linewidth=0.8)
    curve.set_ylabel("normal stress, tension positive [MPa]")
    energies.plot(path.opening * MILLI, path.fracture, color=FRACTURE, label="fracture, mode I")
    energies.plot(path.opening * MILLI, path.stored, color="0.55", linewidth=1.0, label="stored")
    energies.set_ylabel("energy [N/m]")
    energies.set_xlabel("opening [mm]")
    energies.legend(frameon=False, fontsize=9)


def _draw_shear(curve: Any, energies: Any, portrait: Portrait) -> None:
    curve.set_title("slid, back beyond the start, and on", fontsize=10, color="0.3")
    for (compression, path), colour in zip(portrait.shear.items(), COLOURS, strict=True):
        label = f"{compression * MEGA:g} MPa"
        curve.plot(path.slip * MILLI, path.tau * MEGA, color=colour, linewidth=1.6, label=label)
        energies.plot(path.slip * MILLI, path.fracture, color=colour, linewidth=1.4)
        energies.plot(path.slip * MILLI, path.friction, "--", color=colour, linewidth=1.0)
    curve.axhline(0.0, color="0.5", linewidth=0.8)
    curve.set_ylabel("shear stress [MPa]")
    curve.legend(title="compression", frameon=False, fontsize=9)
    energies.plot([], [], color="0.3", label="fracture, mode II")
    energies.plot([], [], "--", color="0.3", label="friction")
    energies.set_ylabel("energy [N/m]")
    energies.set_xlabel("slip [mm]")
    energies.legend(frameon=False, fontsize=9)


def _draw_crushing(curve: Any, plane: Any, crushing: CrushingPortrait) -> None:
    path = crushing.curve
    curve.set_title("pressed, let go, and pressed on", fontsize=10, color="0.3")
    curve.plot(-path.opening * MILLI, -path.sigma * MEGA, color=COLOURS[1], linewidth=1.8)
    curve.set_ylabel("compression [MPa]")
    curve.set_xlabel("closing [mm]")
    work = curve.twinx()
    work.plot(-path.opening * MILLI, path.crushing, color=FRACTURE, linewidth=1.2, label="crushing")
    work.set_ylabel("energy of crushing [N/m]", color=FRACTURE)
    work.spines["top"].set_visible(False)
    for (words, points), colour in zip(crushing.surface.items(), (COLOURS[1], COLOURS[2], "0.55"), strict=False):
        plane.plot(points[:, 0] * MEGA, points[:, 1] * MEGA, color=colour, linewidth=1.4, label=words)
    plane.set_title("normal and shear stress at which a contact yields", fontsize=10, color="0.3")
    plane.set_xlabel("normal stress, tension positive [MPa]")
    plane.set_ylabel("shear stress [MPa]")
    plane.legend(frameon=False, fontsize=9)
