"""Features that each shipped scene leaves out: without effect on its numbers.

That they cost nothing either is held by benchmarks, beside a step written by hand (`verification/reference_step/`).
"""

from collections.abc import Callable, Sequence

import numpy as np

from masonry import scene
from masonry.laboratory import laboratory
from verification.html import page
from verification.studies.parts import PARTS, STEPS, Part, few_steps, march, put_in_the_state_of

ORDER = 40
ROUNDING, ADDED_UP = 1e-14, 1e-12
"""What rounding may do in a few steps, and in a whole run of thousands."""
FEW = 2


def difference(part: Part) -> float:
    """The largest difference between the reduced and the full run, over the largest value.

    The reduced model cracks; the full one is then put in its state, and both take a few steps: forces, motions and
    velocities are compared. (Local damping follows the signs of velocities, so that in a long run any rounding shows.)
    Where the two have other blocks, the forces at every step of the whole run are compared.
    """
    reduced, full = part.models()
    forces = march(reduced)
    if part.same:
        put_in_the_state_of(reduced.model, full.model)
        pairs = list(zip(few_steps(reduced, FEW), few_steps(full, FEW), strict=True))
    else:
        pairs = [(forces, march(full))]
    return max(float(np.abs(a - b).max() / np.abs(a).max()) for a, b in pairs)


def chapter(tell: Callable[[str], None], parts: Sequence[Part] = PARTS, quick: bool = False) -> page.Chapter:
    """A table of all parts, reduced against full; then sizes, what is compiled and what is not, scene by scene."""
    made = page.Chapter("What each scene leaves out")
    rows: list[list[str | page.TableCell]] = []
    wrong, bits = [], 0
    for part in parts:
        tell(f"left out: {part.name}")
        error, limit = difference(part), ROUNDING if part.same else ADDED_UP
        wrong += [] if error <= limit else [part.name]
        bits += error == 0.0
        said = "the same bits" if error == 0.0 else f"{error:.0e}"
        rows.append([part.name, page.judged(said, error <= limit, "" if part.same else "whole run")])
        made.records.append(record(part, error, limit))
    sentence = (
        f"{len(rows)} optional parts: leaving one out gives the same bits in {bits}, and differs by rounding "
        f"(up to {ROUNDING:.0e}, {ADDED_UP:.0e} in a whole run) in the others"
    )
    made.judge("Leaving out", not wrong, f"{sentence}, but for {', '.join(wrong)}." if wrong else f"{sentence}.")
    made.add(*INTRODUCTION, page.table(HEADER, rows, "The same problem without a part, and with it doing nothing"))
    for name in scene.packaged():
        made.add(*shipped(name, tell))
    return made


def record(part: Part, error: float, limit: float) -> dict:
    """One line of records.json."""
    return {
        "case": f"left out: {part.name}",
        "quantity": "largest difference",
        "unit": "1",
        "value": error,
        "reference": 0.0,
        "kind_of_reference": "invariance",
        "error": error,
        "scale": 1.0,
        "tolerance": limit,
        "steps": STEPS,
        "knobs": {},
        "status": "PASS" if error <= limit else "FAIL",
        "reason": "",
    }


def shipped(name: str, tell: Callable[[str], None]) -> list[str]:
    """Features that the step of a packaged scene contains and does not."""
    tell(f"left out: {name}")
    loaded = scene.load(name)
    report = laboratory.check(loaded)
    contacts = ", ".join(f"{count} {group}" for group, count in report["contacts"].items())
    sizes = (
        f"{report['blocks']} blocks, {report['contact_points']} contact points ({contacts}), {report['freedoms']} "
        f"degrees of freedom, {report['steps']} steps of {report['time_step_s']:.3g} s."
    )
    lists = [page.TableCell("\n".join(report[key]), "text") for key in ("compiled", "left_out")]
    warned = page.bullets(report["warnings"]) if report["warnings"] else ""
    return [page.heading(f"{name}: {loaded.title}"), sizes, page.table(["in the step", "left out"], [lists]), warned]


HEADER = ("part", "largest difference")
INTRODUCTION = (
    "The program compiles a step for each scene that holds only what this scene uses. What is listed as left out takes "
    "no time and no memory, and cannot influence the result. That is shown first: the same small problem is run twice, "
    "as the scene compiles it and with the part brought in but doing nothing (loads of zero, a dilation of angle "
    "zero, axes turned by nothing, strengths that are never reached). Once the first has cracked, the second takes its "
    "state, and what both do next is compared: forces, motions, velocities. Where their blocks or memories differ, the "
    "force of the drive at every step of the whole run is. `make bench` times steps beside one written by hand.",
    "Then follows what each scene that comes with the program contains and leaves out.",
)
