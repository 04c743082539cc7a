r"""Bridges under axles that travel: least factor, worst position and envelope, against lines of thrust, and by runs.

       |P     |P                        H, V, M    unknown in the first joint of each arch
    ---v------v-----------  road        then       loads to the left of a joint are taken away
      / \    / \    fill                pier       what the left arch brings, less what the right one takes on
     .-'''-.   .-'''-.                  joint      M about its ends, signs as of pressure; |T| <= mu N
    /       \ /       \                 max        the factor, linear in all of these
   |         |         |
             |         |  pier

Heyman, The masonry arch (1982); Livesley (1978). The line of thrust knows no blocks and no contact points. Melbourne,
Gilbert and Wagstaff (1997) saw in tests of three spans that the arch beside the loaded one takes part, and that the
worst place is nearer to the crown than the quarter of the span: so it is here, where the pier is slender.
"""

import numpy as np

import masonry
from verification.case import Case, Findings, Line, Tolerance
from verification.references.thrust_line import Spans, added, ring
from verification.scene_runs import load
from verification.scene_runs import run as run_scene

G, ACCURACY = 9.81, 0.005
LEVEL, PATCH, TAN = 1.8, 0.3, float(np.tan(np.radians(26.565)))
ONE, TWO = "bridge-single-span", "bridge"
STEP = 0.01
"""m, of the loop over positions by hand."""
RUNS = {
    "one span": (ONE, {}),
    "one span, large displacement": (ONE, {"displacements": "large"}),
    "two spans on a slender pier": (TWO, {}),
    "two spans on a stocky pier": (TWO, {"specimen.pier.0.width": "2 m"}),
}


def spans(width: float | None) -> Spans:
    """The bridge of one span, or that of two on a pier of some width (m)."""
    if width is None:
        return Spans((ring(5.0, 1.2, 0.4, 25),), ())
    return Spans((ring(5.0, 1.2, 0.4, 21, 2.5), ring(5.0, 1.2, 0.4, 21, 7.5 + width)), ((width, 3.0, 8),))


def by_hand(bridge: Spans, axles: list[float]) -> float:
    """The largest factor of axles of 100 kN at these places (m)."""
    extrados = bridge.extrados
    live = added(*(extrados.under_axle(1e5, x, LEVEL, PATCH, TAN) for x in axles))
    return bridge.largest_factor(2200 * G, added(extrados.filled(LEVEL, 1800 * G)), live, 0.7)


def look_at_positions(findings: Findings, name: str, width: float | None) -> None:
    """Factors of the envelope, and the least of them, beside those by hand."""
    bridge = spans(width)
    scene = load(ONE) if width is None else load(TWO, {"specimen.pier.0.width": f"{width} m"})
    result = masonry.limit(scene)
    assert result.envelope is not None and scene.vehicle is not None
    position, factor = result.envelope.along("x")
    shown = np.flatnonzero(factor < 10.0 * result.factor)
    own = np.array([by_hand(bridge, scene.vehicle.places(x).tolist()) for x in position[shown]])
    off = float(np.abs(factor[shown] / own - 1.0).max())
    tolerance = Tolerance(1e-9, 1e-10, "both are linear programmes of the same joints and loads", "limit analysis")
    findings.check(f"largest error of a factor of the envelope, {name}", "1", off, 0.0, tolerance, scale=1.0)
    loop = np.arange(position[shown[0]], position[shown[-1]], STEP)
    least = min(by_hand(bridge, scene.vehicle.places(x).tolist()) for x in loop.tolist())
    tolerance = Tolerance(5e-5, 1e-5, "the loop by hand steps by 10 mm, beside the worst place", "limit analysis")
    findings.check(f"least factor over the positions, {name}", "1", result.factor, least, tolerance)
    reason = "the worst place is found between the steps of the loop"
    findings.at_most(f"least factor over the positions within the loop's, {name}", "1", result.factor, least, reason)
    findings.plot(f"Envelope, {name}", "position of the vehicle (m)", "load factor (1)",
                  Line("masonry limit", position[shown], factor[shown]),
                  Line("line of thrust", position[shown], own, "points"), log=True)  # fmt: skip
    if width is not None:
        moves = bool(result.moving[result.specimen.sets["pier 1"]].any())
        quantity = f"the pier moves where it should stand, or stands, {name}"
        findings.at_most(quantity, "1", moves != (width < 1.5), 0.0, "a stocky pier leaves one arch alone")


def run() -> Findings:
    """The least of a loop by hand, the envelope point by point, and runs at the worst position."""
    findings = Findings()
    for name, width in (("one span", None), ("slender pier", 1.0), ("stocky pier", 2.0)):
        look_at_positions(findings, name, width)
    for name, (base, changes) in RUNS.items():
        bound = masonry.limit(load(base, changes))
        assert bound.scene.vehicle is not None
        there = {"vehicle.position": f"{bound.scene.vehicle.position!r} m", "limit.accuracy": ACCURACY}
        collapse = findings.note(name, run_scene(base, changes | there)).summary["collapse_load"]
        middle = 0.5 * (collapse["borne"] + collapse["falls"])
        tolerance = Tolerance(0.01, 0.5 * ACCURACY, "half the interval", "limit analysis")
        findings.check(f"load factor at the worst position by a run, {name}", "1", middle, bound.factor, tolerance)
    return findings


CASE = Case(
    name="vehicle-on-a-bridge",
    row="A65",
    title="Bridges of one span and of two under axles that travel",
    area="Friction and stability",
    run=run,
    quick=False,
    scene=TWO,
    no_problems="the interval of each run is its error",
)
