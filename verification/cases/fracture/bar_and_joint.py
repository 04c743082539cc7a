"""A bar with one joint across it: the interface model through snap-back, a run on either side of the critical length.

     ///|========== E ==========||========== E ==========|--> U        U = s + t(s) L/E
        |<------------------ L, with joint ------------->|

t(s) is the joint's curve in tension. dU/ds = 1 + t'(s) L/E < 0 somewhere, and the bar snaps back, if L is above

    L_c = E (2 G/f^2 - 1/kn)  linear        2 E G/(alpha f^2)  polynomial        E G/f^2  exponential

(the steepest slope of each law, which the last two have at the peak). Control by the opening follows F(U) all the way.
A drive cannot: above L_c a run falls straight down at the peak, U = f (1/kn + L/E), to the branch that is left. Up to
there it has spent f^2 (1/kn + L/E)/2 a unit of area: what the joint cannot take becomes motion, and is damped.

nu = 0: tets of any shape are exact. Reference: by hand; Bazant and Cedolin, Stability of Structures, on snap-back in
series.
"""

from dataclasses import replace

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.checks import increments
from verification.references.closed_forms import Joint, tension
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import grids
from verification.references.interface.model import model
from verification.references.interface.newton import EquilibriumPath
from verification.scene_runs import assembled

Array = np.ndarray
JOINT, YOUNG, SIDE, NEAR = Joint(), 16.7e9, 0.05, 1e-9
CRITICAL = {
    "linear": YOUNG * (2 * JOINT.G_I / JOINT.fT**2 - 1 / JOINT.kn),
    "polynomial": 2 * YOUNG * JOINT.G_I / (JOINT.alpha * JOINT.fT**2),
    "exponential": YOUNG * JOINT.G_I / JOINT.fT**2,
}
SHORT, LONG = 0.1, 0.6
OPENINGS = np.concatenate(
    [np.linspace(0.0, JOINT.opening_at_peak, 4)[1:], JOINT.opening_at_peak + np.geomspace(1e-7, 4e-5, 40)]
)
SCENE = "bar-and-joint"


def implicit(findings: Findings, law: str, length: float) -> None:
    """F and U of the interface model under control of the opening, against the closed form."""
    side, half = np.array([0.0, SIDE]), 0.5 * length
    body = grids([(side, side, np.array([0.0, half])), (side, side, np.array([half, length]))])
    joint = Law(law, JOINT.kn, JOINT.ks, fT=JOINT.fT, c0=JOINT.c0, G_I=JOINT.G_I, G_II=JOINT.G_II, alpha=JOINT.alpha)
    bar = model(body, YOUNG, 0.0, lambda a, b: joint)
    bar.hold("xyz", lambda x, block: x[:, 2] < NEAR)
    bar.hold("xy", lambda x, block: x[:, 2] > length - NEAR)
    bar.drive("z", lambda x, block: x[:, 2] > length - NEAR)
    points = bar.joints[0]
    path, rows = EquilibriumPath(bar, points.jump.T @ (points.weight[:, None] * points.normal).ravel() / SIDE**2), []
    for s in OPENINGS:
        path.go(float(s))
        rows.append((path.state.factor, path.drive_force() / SIDE**2))
    moved, stress = np.array(rows).T
    exact = tension(law, JOINT, OPENINGS)
    back = bool(np.diff(moved).min() < 0.0)
    snaps = "snaps back" if back else "does not snap back"
    name = f"interface model, {law}, L = {length:g} m ({snaps})"
    for what, value, reference, unit in (
        ("stress", stress, exact, "Pa"),
        ("U", moved, OPENINGS + exact * length / YOUNG, "m"),
    ):
        k = int(np.argmax(np.abs(value - reference)))
        tolerance = Tolerance(1e-12, 1e-13, "Newton's residual of 1e-12 of the force, and rounding")
        quantity = f"{name}: {what} where it is worst"
        findings.check(quantity, unit, value[k], reference[k], tolerance, scale=reference.max())
    quantity = f"{name}: snaps back as L_c says (1 yes, 0 no)"
    findings.check(quantity, "1", back, length > CRITICAL[law], Tolerance(0.0, 0.0, "yes or no"), scale=1.0)
    if law == "exponential":
        line = Line(f"interface model, L = {length:g} m", moved * 1e6, stress / 1e6, "dashed")
        findings.plot(f"Bar of {length:g} m, exponential law", "U (um)", "stress (MPa)", line)


def drawn(findings: Findings, length: float, places: Array) -> tuple[Array, Array]:
    """Stress (Pa) and work per area (J/m2) of a run at each place of the drive (m)."""
    half = f"{0.5 * length!r} m"
    size, above = ["50 mm", "50 mm", half], ["0 m", "0 m", half]
    boxes = {"specimen.box.0.size": size, "specimen.box.1.size": size, "specimen.box.1.origin": above}
    assembly = assembled(SCENE, boxes)
    result = increments.run(assembly, places.tolist(), move=2000, wait=1000)
    rows = findings.note(f"L = {length:g} m", result).history.rows
    plot = next(plot for plot in findings.plots if f"of {length:g} m" in plot.title)
    line = Line(f"run, L = {length:g} m", rows["displacement"] * 1e6, rows["stress"] / 1e6, "points")
    findings.plots[findings.plots.index(plot)] = replace(plot, lines=(*plot.lines, line))
    return rows["stress"][1:], rows["external_work"][1:] / SIDE**2


def torn(moved: Array, length: float) -> Array:
    """Stress (Pa) of the branch on which U (m) and the opening grow together again; all of it where nothing snaps."""
    s = np.linspace(JOINT.opening_at_peak, 2e-4, 400_001)
    u = s + tension("exponential", JOINT, s) * length / YOUNG
    rising = slice(int(np.argmin(u)), None)
    return tension("exponential", JOINT, np.interp(moved, u[rising], s[rising]))


def below(findings: Findings) -> None:
    """A run of a short bar follows the whole curve."""
    top = JOINT.fT * (1 / JOINT.kn + SHORT / YOUNG)
    places = top * np.concatenate([[0.5, 0.9, 1.0], np.linspace(1.0, 8.0, 30)[1:]])
    stress, _ = drawn(findings, SHORT, places)
    exact = np.where(places < top, JOINT.fT * places / top, torn(places, SHORT))
    k = int(np.argmax(np.abs(stress - exact)))
    tolerance = Tolerance(3e-6, 5e-7, "smooth increments and waits: what a swing unloads is reloaded on the secant")
    quantity = "run of a bar below L_c: stress where it is worst"
    findings.check(quantity, "Pa", stress[k], exact[k], tolerance, scale=JOINT.fT)


def above(findings: Findings) -> None:
    """A run of a long bar falls at the peak, to the other branch, and loses what the joint does not take."""
    top = JOINT.fT * (1 / JOINT.kn + LONG / YOUNG)
    step = 1e-3 * top
    places = np.concatenate([top * np.linspace(0.1, 0.9, 9), [top - step, top + step], top * np.linspace(1.1, 2.5, 15)])
    stress, work = drawn(findings, LONG, places)
    tolerance = Tolerance(1e-8, 1e-9, "elastic, and at rest")
    reference = JOINT.fT * (1.0 - step / top)
    findings.check(
        "run of a bar above L_c: stress just before the peak", "Pa", stress[9], reference, tolerance, scale=JOINT.fT
    )
    tolerance = Tolerance(
        3e-3, 1.5e-3, "an increment of 2e-3 of U while the bar falls, and the drag of damping on the way up"
    )
    findings.check("run of a bar above L_c: work up to the fall", "J/m2", work[10], 0.5 * JOINT.fT * top, tolerance)
    tolerance = Tolerance(
        1e-6, 1e-7, "the swing after the fall opened the joint farther than rest does; at 2.5 U_peak that is passed"
    )
    quantity = "run of a bar above L_c: stress on the other branch at 2.5 U_peak"
    findings.check(quantity, "Pa", stress[-1], torn(places[-1:], LONG)[0], tolerance, scale=JOINT.fT)


def run() -> Findings:
    """Interface model with three laws above and below L_c; runs of the exponential one."""
    findings = Findings()
    for law in CRITICAL:
        implicit(findings, law, LONG)
        implicit(findings, law, SHORT)
    below(findings)
    above(findings)
    return findings


CASE = Case(
    "bar-and-joint",
    "A6",
    "A bar with a joint: snap-back above a length",
    area="Fracture",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("tension-linear", "tension-polynomial", "tension-exponential"),
)
