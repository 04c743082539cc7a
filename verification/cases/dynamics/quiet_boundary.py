"""A wave in a column of tets between quiet boundaries: what comes in, what comes back, what is lost.

    v_in ->  |==================|  quiet     traction -rho c v, and 2 rho c v_in of a wave that comes in
             |==================|  free      a free end moves twice as fast as the wave

On a lumped chain of elements of length h a dashpot rho c at its end reflects -tan^2(kappa/4), sin(kappa/2) = w h/(2 c):
0.1249, 0.0260, 0.00625, 0.00155 at 5, 10, 20, 40 elements a wavelength. In steps of dt, by the dashpot at the middle of
the step, (cos(w dt/2) - cos(kappa/2))/(cos(w dt/2) + cos(kappa/2)), sin(kappa/2) = h/(c dt) sin(w dt/2). The column is
so thin that all nodes of a section move alike. Its end moves by 1 + R of a wave that comes back.

Lysmer and Kuhlemeyer (1969), J. Eng. Mech. Div. 95(4), 859-877.
"""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.structured import row_of_boxes
from verification.scene_runs import loaded

SPEED, DENSITY, WIDTH = 2000.0, 2500.0, 0.1
"""m/s and kg/m3 of the scene's column, and its thickness in m; elements are 1 m long."""
PEAK, SHORT, LONG = 1e-3, 1e-3, 4e-3
"""m/s of a bell in time, and its two widths, s: 2 elements long, and 8."""
PER_WAVELENGTH = (5, 10, 20, 40)
KIND = "closed form"
Tables = Sequence[dict[str, Any]]
QUIET: Tables = ({"on": "box 0.x+"},)


def run_of(findings: Findings, name: str, length: int, width: float, far: Tables, time: float) -> Result:
    """A bell of some width (s) comes in at one end of a column so long (m); the far end is quiet, or free."""
    keys = {"solver.duration": f"{time} s", "solver.sampling": "8 kHz"}
    specimen, mesh = row_of_boxes([0.0, float(length)], [(length, 1, 1)], WIDTH, WIDTH, WIDTH**2)
    with TemporaryDirectory() as folder:
        record = Path(folder) / "bell.csv"
        when = np.linspace(0.0, 12.0 * width, 601)
        speed = PEAK * (np.exp(-0.5 * (when / width - 6.0) ** 2) - np.exp(-18.0))
        np.savetxt(record, np.column_stack([when, speed]), delimiter=",", header="time,speed", comments="", fmt="%.17g")
        wave = {"record": str(record), "quantity": "velocity", "unit": "m/s", "x": "speed"}
        quiet = [{"on": "box 0.x-", "wave": wave}, *far]
        with loaded("column-with-quiet-ends", {"quiet": quiet} | keys, specimen, mesh) as scene:
            result = laboratory.run(scene)
    findings.note(name, result)
    return result


def reflections(result: Result, split: float) -> list[float]:
    """|R| at each wavelength, of what comes back to the end after `split` s over what came in before."""
    time, speed = result.history.rows["time"], result.history.rows["in"]
    ratios = []
    for per in PER_WAVELENGTH:
        wave = speed * np.exp(-2j * np.pi * SPEED / per * time)
        ratio = abs(wave[time >= split].sum()) / abs(wave[time < split].sum())
        ratios.append(float(0.5 * (1.0 - np.sqrt(1.0 - 4.0 * ratio))))
    return ratios


def in_steps(per: int, dt: float) -> float:
    """|R| of the leapfrog."""
    half = np.pi * SPEED / per * dt
    cosine = np.cos(np.arcsin(np.sin(half) / (SPEED * dt)))
    return float((np.cos(half) - cosine) / (np.cos(half) + cosine))


def run() -> Findings:
    """Reflection at four wavelengths; a free end; the energy that passes."""
    findings = Findings()
    result = run_of(findings, "quiet end", 200, SHORT, QUIET, 0.42)
    dt = float(result.summary["time_step_s"])
    for per, value in zip(PER_WAVELENGTH, reflections(result, 0.15), strict=True):
        table = float(np.tan(0.5 * np.arcsin(np.pi / per)) ** 2)
        tolerance = Tolerance(1e-2, 5e-3, "steps of finite length reflect less, by (w dt)^2/8 over R")
        findings.check(f"reflected at {per} elements a wavelength", "1", value, table, tolerance)
        tolerance = Tolerance(5e-3, 1.7e-3, "what is slow is still under way at the split")
        findings.check(f"the same, of the leapfrog, at {per}", "1", value, in_steps(per, dt), tolerance)
    findings.plot("The end at which a wave comes in", "time (s)", "velocity (mm/s)",
                  Line("end", result.history.rows["time"], 1e3 * result.history.rows["in"]))  # fmt: skip
    for name, far, times in (("free", (), 2.0), ("quiet", QUIET, 1.0)):
        long = run_of(findings, f"{name} far end", 60, LONG, far, 0.1)
        rows = long.history.rows
        tolerance = Tolerance(3e-3, 1e-3, "waves of 40 elements disperse a little on the way")
        value = float(rows["out"].max()) / PEAK
        findings.check(f"velocity of a {name} far end over the wave's", "1", value, times, tolerance)
    energy = DENSITY * SPEED * WIDTH**2 * PEAK**2 * LONG * np.sqrt(np.pi)
    tolerance = Tolerance(1e-3, 3e-4, "a dashpot takes the wave at the far end, and as much where the stress brings it")
    findings.check("energy that comes in and leaves", "J", 0.5 * float(rows["damping"][-1]), energy, tolerance)
    return findings


CASE = Case(
    "quiet-boundary",
    "A45",
    "A wave leaves through a quiet boundary",
    area="Dynamics",
    run=run,
    scene="column-with-quiet-ends",
    no_problems="what is reflected at so many elements a wavelength is the error itself, over their number",
)
