"""Section 4, first half: two units and one joint under confinement and shear; Table 1, Figs. 3, 4 and 6."""

import numpy as np
from matplotlib.figure import Figure

from masonry.laboratory.result import Result
from masonry.pictures.style import MEGA, MILLI
from verification.html.figures import COLOURS
from verification.html.page import paragraph, picture
from verification.paper import pictures
from verification.paper.couplets import contact_points, energies, laws, printed, setups
from verification.paper.couplets.laws import CONFINEMENTS, LAWS, joint, name
from verification.paper.experiment import Done, Experiment, Run, Section
from verification.paper.pictures import Line
from verification.references.closed_forms import Joint, shear, tension

PULLED = {
    "confinement": "0 MPa",
    "drive.direction": "z",
    "drive.displacement": f"{energies.OPENED * MILLI:g} mm",
    "support.1.fix": ["x", "y", "rotation"],
}
LAST, OPENED, POINTS_OF_CURVE = 1e-3, energies.OPENED, 500
BLACK = "0.1"


def runs(quick: bool) -> dict[str, Run]:
    """Laws by confinements; in full each law in tension too, and the other set-ups."""
    made = {name(law, c): Run("couplet", {"law": law, "confinement": c}) for law in LAWS for c in CONFINEMENTS}
    if quick:
        return made
    made |= {f"{law}, tension": Run("couplet", {"law": law, **PULLED}) for law in LAWS}
    return made | dict(setups.runs()) | dict(contact_points.runs())


def show(done: Done) -> Section:
    """Figures and claims."""
    parts = [
        paragraph(LEAD),
        picture(figure_6(done), "Fig. 6 as ours: two rigid units, a panel for each confinement. Dotted: closed forms."),
        picture(misprint(), "Eq. (15) under 0.1 MPa, beta = 2.1: as printed, and as mended."),
    ]
    if not done.quick:
        parts.insert(2, picture(portraits(done), PORTRAITS))
        parts += [picture(other_setups(done), SETUPS, "half"), picture(by_points(done), POINTS, "half")]
    claims = [
        *laws.claims(done),
        *energies.claims(done),
        *setups.claims(done),
        *contact_points.claims(done),
    ]
    return Section(parts, claims, laws.records(done), misprints=printed.misprints())


def figure_6(done: Done) -> Figure:
    """Confinements side by side, a line for each law."""
    panels = {c: [line for law in LAWS for line in slid(done, law, c)] for c in CONFINEMENTS}
    return _plain(pictures.curves(panels, "slip [mm]", "shear stress [MPa]"))


def slid(done: Done, law: str, confinement: str) -> list[Line]:
    """A law in shear, and its closed form."""
    u = np.linspace(0.0, LAST, POINTS_OF_CURVE)
    exact = shear(law, joint(confinement), u, CONFINEMENTS[confinement])
    return [_line(law, done[name(law, confinement)]), Line("", u * MILLI, exact * MEGA, "--", BLACK)]


def pulled(done: Done, law: str) -> list[Line]:
    """A law in tension, and its closed form."""
    u = np.linspace(0.0, OPENED, POINTS_OF_CURVE)
    return [_line(law, done[f"{law}, tension"]), Line("", u * MILLI, tension(law, Joint(), u) * MEGA, "--", BLACK)]


def portraits(done: Done) -> Figure:
    """The laws in tension and in shear, from runs of one joint."""
    panels = {
        "tension": [line for law in LAWS for line in pulled(done, law)],
        "shear under 0.5 MPa": [line for law in LAWS for line in slid(done, law, "0.5 MPa")],
    }
    figure = _plain(pictures.curves(panels, "opening or slip [mm]", "stress [MPa]"))
    for axes, last in zip(figure.axes, (0.05, 0.4), strict=True):
        axes.set_xlim(-0.02 * last, last)
    return figure


def misprint() -> Figure:
    """Cohesion left and friction by eq. (15), as printed and as mended."""
    properties, s, slip = (
        joint("0.1 MPa"),
        0.1e6,
        np.linspace(float(joint("0.1 MPa").peak(0.1e6)) / joint("0.1 MPa").ks, 1e-3),
    )
    shown, right = printed.intact_fraction(properties, slip, s), printed.mended_fraction(properties, slip, s)
    mended = properties.tan_res + right * (properties.tan0 - properties.tan_res)
    cohesion = [Line("as printed", slip * MILLI, shown), Line("as mended", slip * MILLI, right)]
    friction = [
        Line("as printed", slip * MILLI, printed.friction(properties, shown)),
        Line("as mended", slip * MILLI, mended),
    ]
    return pictures.curves({"share of the cohesion left": cohesion, "tan(phi)": friction}, "slip [mm]", "[1]")


def other_setups(done: Done) -> Figure:
    """One joint, loaded in three ways."""
    high = setups.HIGH
    lines = [
        pictures.stress_line("rigid units", done[name("exponential", high)]),
        pictures.stress_line("affine units between plates", done[setups.PLATED.format(high)]),
        pictures.stress_line("units of tets, held by their faces", done[setups.HELD.format(high)]),
    ]
    figure = pictures.curves({f"exponential law, {high}": lines}, "displacement [mm]")
    figure.axes[0].set_xlim(-0.01, 0.5)
    return figure


def by_points(done: Done) -> Figure:
    """Peaks against the number of contact points."""
    lines = [
        Line(
            law,
            np.array(contact_points.POINTS),
            np.array([done.peak(contact_points.TURNING.format(law, n)) for n in contact_points.POINTS]) * MEGA,
            "o-",
        )
        for law in ("brittle", "exponential")
    ]
    figure = pictures.curves(
        {f"unit free to turn, {contact_points.HIGH}": lines}, "contact points along the joint", "peak [MPa]"
    )
    figure.axes[0].set(ylim=(0.0, 2.0), xticks=contact_points.POINTS)
    figure.axes[0].legend(loc="lower right", frameon=False, fontsize=8)
    return figure


def _line(law: str, result: Result) -> Line:
    return pictures.stress_line(law, result, colour=COLOURS[LAWS.index(law)])


def _plain(figure: Figure) -> Figure:
    """Closed forms thin, and once in the key."""
    for axes in figure.axes:
        dashed = [line for line in axes.lines if line.get_linestyle() == "--"]
        for line in dashed:
            line.set(linewidth=1.0, dashes=(2.0, 7.0), zorder=4)
        handles, labels = axes.get_legend_handles_labels()
        axes.legend([*handles, *dashed[:1]], [*labels, "closed form"][: len(handles) + 1], frameon=False, fontsize=8)
    return figure


LEAD = (
    "Two units with one joint are confined, then the upper one slides. Table 1 gives the joint; its c_res is taken as "
    "0, and beta of the polynomial law at 0.5 MPa is interpolated between the two values given."
)
PORTRAITS = (
    "Figs. 3 and 4 as ours, with the exponential law beside them: one joint pulled apart and sheared. Dotted: closed "
    "forms of eqs (12) to (17), as mended."
)
SETUPS = "One joint in three set-ups: what the units add, and what a moment along the joint takes."
POINTS = "The peak by the number of contact points, stress not being uniform."

EXPERIMENT = Experiment("couplet", "Couplet under confinement and shear", 10, runs, show)
