"""Section 4, second half: two units and a bed of random cells under confinement and shear; Table 2, Figs. 7 and 8."""

import numpy as np
from matplotlib.figure import Figure

from masonry.pictures.style import MEGA, MILLI
from verification.html.figures import COLOURS
from verification.html.page import paragraph, picture
from verification.paper import pictures
from verification.paper.couplets import assumed, beds, cells, mortar
from verification.paper.couplets.laws import CONFINEMENTS
from verification.paper.couplets.measures import strength_line
from verification.paper.couplets.mortar import SEMI_RIGID, SIZES, known, name
from verification.paper.experiment import Done, Experiment, Run, Section
from verification.paper.pictures import Line
from verification.references.closed_forms import Joint, shear


def runs(quick: bool) -> dict[str, Run]:
    """Sizes by confinements, and weaker beds; in full other seeds, blocks that deform, and other assumptions."""
    made = mortar.runs(quick) | beds.runs(quick)
    return made if quick else made | assumed.runs()


def show(done: Done) -> Section:
    """Figures and claims."""
    names = [beds.label(size, c, ratio) for ratio in (beds.SHIPPED, beds.WEAK) for size, c in beds.SHOWN]
    shown = {name: done[name] for name in names}
    parts = [
        paragraph(LEAD),
        picture(figure_7(done), FIGURE_7),
        picture(strengths(done), STRENGTHS, "half"),
        picture(pictures.cracks(shown, 1), FIGURE_8),
        *beds.parts(done),
        *assumed.parts(done),
    ]
    claims = [
        *mortar.claims(done),
        *cells.claims(done),
        *beds.claims(done),
        *assumed.claims(done),
    ]
    return Section(parts, claims, mortar.records(done))


def figure_7(done: Done) -> Figure:
    """Confinements side by side, a line for each size; the joint that was fitted to the tests as dashes."""
    panels = {}
    for c, sigma in CONFINEMENTS.items():
        labels = {size: name(size, c) for size in SIZES if c in known(done, size)}
        labels |= {"coarse, semi-rigid": SEMI_RIGID.format(c)} if SEMI_RIGID.format(c) in done.runs else {}
        lines = [pictures.stress_line(word, done[label]) for word, label in labels.items()]
        u = np.linspace(0.0, float(lines[0].x[-1]), 500)
        law = np.asarray(shear("exponential", Joint(), u / MILLI, sigma)) * MEGA
        panels[c] = [*lines, Line("two blocks of Fig. 6, closed form", u, law, "--", "0.4")]
    figure = pictures.curves(panels, "displacement [mm]", "shear stress [MPa]")
    for axes, sigma in zip(figure.axes, CONFINEMENTS.values(), strict=True):
        axes.set_ylim(0.0, 1.45 * float(Joint().peak(sigma)) * MEGA)
    return figure


def strengths(done: Done) -> Figure:
    """Peaks against confinement, every seed, and the lines through those of the first."""
    reach = np.array([0.0, 1.1])
    lines = [Line("given to the contacts", reach, np.asarray(Joint().peak(reach / MEGA)) * MEGA, "--", "0.4")]
    for colour, size in zip(COLOURS, SIZES, strict=False):
        at = known(done, size)
        if len(at) > 1:
            peaks = [done.peak(name(size, c)) for c in at]
            cohesion, tangent = strength_line([CONFINEMENTS[c] for c in at], peaks)
            lines.append(Line(size, reach, cohesion * MEGA + reach * tangent, "-", colour))
        places = [
            (CONFINEMENTS[c] * MEGA, done.peak(name(size, c, seed)) * MEGA)
            for c in CONFINEMENTS
            for seed in mortar.SEEDS
            if name(size, c, seed) in done.runs
        ]
        sigma, peak = np.array(places).T
        lines.append(Line("", sigma, peak, "o", colour))
    figure = pictures.curves({"peaks of every seed": lines}, "confinement [MPa]", "peak [MPa]")
    figure.axes[0].set_ylim(0.0, 2.2)
    figure.axes[0].legend(loc="lower right", frameon=False, fontsize=8)
    return figure


LEAD = (
    "The joint is now a bed of mortar, 15 mm of about 100 or 300 random cells. Table 2 is lost: the interfaces have "
    "the strengths and energies of Table 1, the bed four times as much. Stiffness by eq. (18). Of the "
    "tests Table 1 is all there is: the joint of Fig. 6, which was fitted to them, stands in their place."
)
FIGURE_7 = "Fig. 7 as ours, a panel for each confinement. The curves of the tests are lost."
FIGURE_8 = "Fig. 8 as ours, at the end of the runs: the shipped bed, and one that is no stronger than its interfaces."
STRENGTHS = "What a test of this couplet would measure, beside what its contacts have."

EXPERIMENT = Experiment("meso-couplet", "Couplet with a bed of mortar", 20, runs, show)
