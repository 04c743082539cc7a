"""How peak and crack pattern in horizontal bending depend on the two tensile strengths that Table 5 has lost."""

import numpy as np
from matplotlib.figure import Figure

from masonry import scene
from verification.html import page
from verification.html.figures import COLOURS, sheet
from verification.paper.bending.by_hand import BentWall, bending_spec, wall_of
from verification.paper.bending.crack import FlexuralCrack, flexural_crack
from verification.paper.bending.runs import ASSUMED, SCENES, STRENGTHS, label, walls
from verification.paper.experiment import Done

MARK = {"stepped": ("s", COLOURS[0]), "mixed": ("D", COLOURS[4]), "straight": ("|", COLOURS[1])}
HEADER = (
    *("fT interface / units [MPa]", "pre-compression", "by hand, brittle [MPa]", "peak M/W [MPa]"),
    *("by hand, plastic [MPa]", "crack", "courses with cracked units", "of the section within units"),
    "broken bed joints, sections",
)
CAPTION = (
    "Crack pattern and peak stress M/W by the tensile strengths of interfaces and units. Lines: where by hand the "
    "crack round all units and the one straight through them need the same moment; above, the stepped one is weaker."
)


def crack_of(done: Done, name: str) -> FlexuralCrack:
    """The crack at the end of a run."""
    return flexural_crack(done[name], bending_spec(_scene(done, name)))


def wall_by_hand(done: Done, name: str) -> BentWall:
    """The wall of a run, for estimates by hand."""
    return wall_of(_scene(done, name))


def _scene(done: Done, name: str) -> scene.Scene:
    return scene.load(done.runs[name].scene, done.runs[name].settings)


def parts(done: Done) -> list[str]:
    """The map, and the table of its numbers."""
    rows = []
    for pair, sigma in walls(STRENGTHS):
        run = label(pair, sigma)
        crack, peak = crack_of(done, run), done.peak(run)
        low, high = wall_by_hand(done, run).bounds()
        numbers = (f"{1e-6 * value:.3g}" for value in (low, peak, high))
        fractions = (f"{100 * crack.unit_fraction:.0f} %", f"{crack.fractions['bed joints']:.2f}")
        name = f"{pair[0]:g} / {pair[1]:g}" + (", as shipped" if pair == ASSUMED else "")
        rows.append([name, sigma, *numbers, crack.word, str(crack.through), *fractions])
    return [page.picture(picture(done), CAPTION), page.table(HEADER, rows, "Peak and crack by the lost strengths.")]


def picture(done: Done) -> Figure:
    """A panel for each pre-compression."""
    figure, axes = sheet(1, len(SCENES), (10.0, 4.4), sharey=True)
    for ax, sigma in zip(axes.flat, SCENES, strict=True):
        ax.set(title=f"pre-compression {sigma}", xlabel="tensile strength of interfaces [MPa]", xlim=(0.15, 0.65))
        for pair in STRENGTHS:
            run = label(pair, sigma)
            mark, colour = MARK[crack_of(done, run).word]
            ax.plot(*pair, mark, color=colour, markersize=11, markeredgewidth=3.0)
            ax.annotate(f"{1e-6 * done.peak(run):.2f} MPa", pair, (11, -3), textcoords="offset points", fontsize=8)
        across, wall = np.linspace(0.15, 0.65, 30), wall_by_hand(done, label(ASSUMED, sigma))
        for behaviour, style in (("brittle", "--"), ("plastic", ":")):
            limits = [even(wall, 1e6 * x, behaviour) for x in across]
            ax.plot(across, np.array(limits) * 1e-6, style, color="0.4", linewidth=1.2, label=f"by hand, {behaviour}")
        ax.set_ylim(0.4, 5.5)
        for word, (mark, colour) in MARK.items():
            ax.plot([], [], mark, color=colour, markersize=8, markeredgewidth=2.5, label=word)
    axes[0, 0].set_ylabel("tensile strength of units [MPa]")
    axes[0, -1].legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=8)
    return figure


def even(wall: BentWall, interface: float, behaviour: str) -> float:
    """Strength (Pa) of units with which the stepped and the straight crack carry the same, by hand."""
    pressed = wall.shear - 1.5 * wall.interface
    tried = [
        BentWall(interface, units, 1.5 * interface + pressed, wall.overlap, wall.thickness, wall.height, wall.courses)
        for units in (0.0, 1e6)
    ]
    straight, stepped = max(wall.paths()), min(wall.paths())
    at_none, at_one = (getattr(w, behaviour)(straight) for w in tried)
    return float((getattr(tried[0], behaviour)(stepped) - at_none) / (at_one - at_none) * 1e6)
