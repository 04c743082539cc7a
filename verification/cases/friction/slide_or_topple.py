"""A wall under a horizontal acceleration slides or topples: a/g = min(mu, b/h).

         b
       _____
      |     |            a topple about the toe: m a h/2 = m g b/2
      |_____|            a slide: m a = mu m g
      |     | h
      |_____|  -> a      The wall is one block, or a stack of courses that lift off together from the base.
      |_____|
    ///////////          Coulomb (1773); West (in Milne 1885) for overturning.

Joints bear no tension. Their contact points stand on the edges ("vertex"), so the toe is where the drawing has it:
points inside the joint would topple early, by their distance from the edge.
"""

from functools import partial

from verification.case import Case, Findings, Tolerance
from verification.fixtures.thresholds import threshold
from verification.scene_runs import run as run_scene

HEIGHT, WIDTH, G = 1.2, 0.4, 9.81
NORMAL, DENSITY = 2e10, 2000.0
HALVINGS = 6

SCENES = {1: "wall-of-one-course", 3: "wall-of-three-courses"}
"""Of walls of so many courses on a base."""


def falls(findings: Findings, courses: int, mu: float, a: float) -> bool:
    """Whether the wall goes on moving: it runs away, or has gone 20 times as far as springs let it."""
    overrides = {"gravity.x": f"{a * G!r} m/s^2", "contact.unit_unit.tan_friction_angle": mu}
    ran = run_scene(SCENES[courses], overrides)
    result = findings.note(f"{courses} courses, mu = {mu}, a/g = {a:.6f}", ran)
    elastic = DENSITY * G * HEIGHT / NORMAL * (HEIGHT / WIDTH) ** 2
    return not ran.ok or abs(result.history.frames[-1].corners).max() > 20 * elastic


def run() -> Findings:
    """One block and a stack, with much friction and with little."""
    findings = Findings()
    for courses, mu, what in ((1, 0.7, "topples"), (1, 0.25, "slides"), (3, 0.7, "topples"), (3, 0.25, "slides")):
        limit = min(mu, WIDTH / HEIGHT)
        value, width = threshold(partial(falls, findings, courses, mu), 0.97 * limit, 1.03 * limit, HALVINGS)
        tolerance = Tolerance(
            3e-3,
            width / limit + 4e-4,
            "edge contacts make the limit exact; what is left is that a fall just above it has to get somewhere in "
            "the time that the run has",
        )
        findings.check(f"a/g at which a wall of {courses} course(s) {what} (mu = {mu})", "1", value, limit, tolerance)
    return findings


CASE = Case(
    name="slide-or-topple",
    row="A14",
    title="A wall slides or topples under a horizontal acceleration",
    area="Friction and stability",
    run=run,
    quick=True,
    scene=SCENES[1],
    no_problems="a yes or no, bisected: the width that is left is the error, and each half of it costs a run",
)
