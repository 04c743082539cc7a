"""A scene's run held against its interface model on the same mesh: curves, displacements of all nodes, energy."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from masonry.assembly.assemble import Assembly
from verification.case import Findings, Line, Tolerance
from verification.checks import increments
from verification.checks.paired_run import interface_model
from verification.references.interface.model import InterfaceModel
from verification.references.interface.newton import EquilibriumPath
from verification.references.interface.points import PointHistory

Array = np.ndarray
DEAD_WAITS = 4
"""Waits of the run while its dead loads rise."""


@dataclass(frozen=True)
class Allowed:
    """Difference over the peak stress that the method should have, and the tolerance, before and after first damage."""

    elastic: tuple[float, float]
    softening: tuple[float, float]
    nodes: tuple[float, float]


def compare(
    findings: Findings,
    name: str,
    make: Callable[[], Assembly],
    conditions: Callable[[InterfaceModel], None],
    places: Sequence[float],
    allowed: Allowed,
    move: int,
    wait: int,
    parts: int | tuple[int, int] = 1,
) -> None:
    """Run a scene through `places` (m) and its interface model under `conditions`; add checks and a plot.

    move, wait  steps of the run to each place, and at rest there      parts  implicit steps to each place; of two
    numbers, the second twice the first, both are taken and their error of first order is extrapolated away
    """
    assembly = make()
    settle = DEAD_WAITS if (model := under(conditions, assembly)).dead.any() else 0
    coarse, fine = parts if isinstance(parts, tuple) else (0, parts)
    force, harm, path = follow(model, places, fine)
    moved = model.displacement(path.displacements())
    if coarse:
        other = under(conditions, assembly)
        other_force, _, other_path = follow(other, places, coarse)
        force = 2.0 * force - other_force
        moved = 2.0 * moved - other.displacement(other_path.displacements())
    stress, peak = force / assembly.specimen.section, float(np.abs(force).max()) / assembly.specimen.section
    result = findings.note(name, increments.run(assembly, places, move, wait, settle))
    ran = result.history.rows["stress"][1 + settle :]
    sound = harm == 0.0
    why = "both models are one discretisation; "
    ranges = [
        ("elastic range", sound, allowed.elastic, why + "what is left is how far each wait of the run comes to rest"),
        ("softening", ~sound, allowed.softening, why + "a run passes each increment with a swing that dies out, so "
         "contacts unload and reload by a little, and its square is lost"),
    ]  # fmt: skip
    for what, which, (expected, limit), reason in ranges:
        if not which.any():
            continue
        k = np.flatnonzero(which)[int(np.argmax(np.abs(ran - stress)[which]))]
        tolerance = Tolerance(limit, expected, reason, "same discretisation")
        quantity = f"{name}: stress where the curves differ most, {what}"
        findings.check(quantity, "Pa", ran[k], stress[k], tolerance, scale=peak)
    apart = np.abs(result.history.frames[-1].nodes - moved).max()
    tolerance = Tolerance(allowed.nodes[1], allowed.nodes[0], why + "as above", "same discretisation")
    quantity = f"{name}: largest difference of a node's displacement at the end"
    findings.check(quantity, "m", apart, 0.0, tolerance, scale=places[-1])
    where = np.asarray(places) * 1e6
    lines = (Line("interface model, tier 1", where, stress / 1e6, "dashed"), Line("run", where, ran / 1e6, "points"))
    findings.plot(name, "displacement of the drive (um)", "stress (MPa)", *lines)


def under(conditions: Callable[[InterfaceModel], None], assembly: Assembly) -> InterfaceModel:
    """The interface model of an assembly, held and loaded."""
    model = interface_model(assembly)
    conditions(model)
    return model


def follow(model: InterfaceModel, places: Sequence[float], parts: int = 1) -> tuple[Array, Array, EquilibriumPath]:
    """Force of the drive (N) at each place under displacement control, the most strength lost there, and the path.

    Dead loads rise in as many parts as the way to DEAD_WAITS places has: a joint may crush while they do.
    """
    path, force, harm = EquilibriumPath(model), [], []
    if model.dead.any():
        for load_factor in np.linspace(0.0, 1.0, DEAD_WAITS * parts + 1)[1:]:
            path.go(0.0, dead=float(load_factor))
    for before, place in zip([0.0, *places[:-1]], places, strict=True):
        for part in range(1, parts + 1):
            path.go(before + (place - before) * part / parts)
        force.append(path.drive_force())
        harm.append(max(most_harmed(history) for history in path.state.histories))
    return np.array(force), np.array(harm), path


def most_harmed(history: PointHistory) -> float:
    """Largest share of its strength that a point lost; 1 where one has crushed."""
    return 1.0 if history.hardening.any() else 1.0 - float(min(history.tension.min(), history.shear.min()))
