"""Features that each shipped scene leaves out: without effect on its numbers, and without cost."""

import time
from collections.abc import Callable, Sequence

import numpy as np

from masonry import scene
from masonry.laboratory import laboratory
from verification.html import page
from verification.studies.parts import PARTS, STEPS, Part, few_steps, march, put_in_the_state_of

ORDER = 40
ROUNDING, ADDED_UP = 1e-14, 1e-12
"""What rounding may do in a few steps, and in a whole run of thousands."""
ROUNDS, QUICK_ROUNDS, FEW = 7, 2, 2
NOISE = 1.1
"""What two times of the same work may differ by on a machine that does other things as well."""


def compare(part: Part, rounds: int) -> tuple[float, float, float]:
    """(largest difference over the largest value, seconds of the reduced and of the full run).

    The reduced model cracks; the full one is then put in its state, and both take a few steps: forces, motions and
    velocities are compared. (Local damping follows the signs of velocities, so that in a long run any rounding shows.)
    Where the two have other blocks, the forces at every step of the whole run are compared.
    Times are the least of rounds in turn.
    """
    times = np.full((rounds + 1, 2), np.inf)
    for k in range(rounds + 1):
        reduced, full = part.models()
        forces = []
        for which, assembly in enumerate((reduced, full)):
            begun = time.perf_counter()
            forces.append(march(assembly))
            times[k, which] = time.perf_counter() - begun
    if part.same:
        _, full = part.models()
        put_in_the_state_of(reduced.model, full.model)
        pairs = list(zip(few_steps(reduced, FEW), few_steps(full, FEW), strict=True))
    else:
        pairs = [(forces[0], forces[1])]
    off = max(float(np.abs(a - b).max() / np.abs(a).max()) for a, b in pairs)
    least = times[min(rounds, 1) :].min(axis=0)  # the first round compiles
    return off, float(least[0]), float(least[1])


def chapter(tell: Callable[[str], None], parts: Sequence[Part] = PARTS, quick: bool = False) -> page.Chapter:
    """A table of all parts, reduced against full; then sizes, what is compiled and what is not, scene by scene."""
    made = page.Chapter("What each scene leaves out")
    rows: list[list[str | page.TableCell]] = []
    wrong, slow, bits = [], [], 0
    for part in parts:
        tell(f"left out: {part.name}")
        off, reduced, full = compare(part, QUICK_ROUNDS if quick else ROUNDS)
        ratio, limit = reduced / full, ROUNDING if part.same else ADDED_UP
        wrong += [] if off <= limit else [part.name]
        slow += [] if ratio <= NOISE else [part.name]
        bits += off == 0.0
        said = "the same bits" if off == 0.0 else f"{off:.0e}"
        times = [f"{1e6 * seconds / STEPS:.2f} us" for seconds in (reduced, full)]
        faster = page.judged(f"{ratio:.2f}", "ok" if ratio <= NOISE else "warn")
        rows.append([part.name, page.judged(said, off <= limit, "" if part.same else "whole run"), *times, faster])
        made.records.append(record(part, off, limit, reduced, full))
    sentence = (
        f"{len(rows)} optional parts: leaving one out gives the same bits in {bits}, and differs by rounding "
        f"(up to {ROUNDING:.0e}, {ADDED_UP:.0e} in a whole run) in the others"
    )
    sentence += f", but for {', '.join(wrong)}" if wrong else ""
    sentence += f"; a step takes longer without {', '.join(slow)}." if slow else "; no step is slower for it."
    made.judge("Leaving out", "bad" if wrong else "warn" if slow else "ok", sentence)
    made.add(*INTRODUCTION, page.table(HEADER, rows, "The same problem without a part, and with it doing nothing"))
    for name in scene.packaged():
        made.add(*shipped(name, tell))
    return made


def record(part: Part, off: float, limit: float, reduced: float, full: float) -> dict:
    """One line of records.json."""
    return {
        "case": f"left out: {part.name}",
        "quantity": "largest difference",
        "unit": "1",
        "value": off,
        "reference": 0.0,
        "kind_of_reference": "invariance",
        "error": off,
        "scale": 1.0,
        "tolerance": limit,
        "seconds": reduced,
        "seconds_full": full,
        "steps": STEPS,
        "knobs": {},
        "status": "PASS" if off <= limit else "FAIL",
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


HEADER = ("part", "largest difference", "a step without it", "a step with it", "without / with")
INTRODUCTION = (
    "The program compiles a step for each scene that holds only what this scene uses. What is listed as left out takes "
    "no time and no memory, and cannot influence the result. That is shown first: the same small problem is run twice, "
    "as the scene compiles it and with the part brought in but doing nothing (loads of zero, a dilation of angle "
    "zero, axes turned by nothing, strengths that are never reached). Once the first has cracked, the second takes its "
    "state, and what both do next is compared: forces, motions, velocities. Where their blocks or memories differ, the "
    "force of the drive at every step of the whole run is. Times are the least of several rounds in turn.",
    "Then follows what each scene that comes with the program contains and leaves out.",
)
