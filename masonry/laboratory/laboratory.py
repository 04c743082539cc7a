"""Run a scene, or look at it first: what a Python user and the command line both call."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from masonry.assembly.assemble import Assembly, assemble, material_of
from masonry.assembly.conditions import impedance_of, select
from masonry.assembly.growing_loads import require_axles_to_load
from masonry.assembly.masses import added_mass_lines
from masonry.errors import Stopped
from masonry.estimates.inspection import Inspection
from masonry.judgement.judgement import judge
from masonry.laboratory.added_parts import bar_lines, slab_lines
from masonry.laboratory.cost import candidates, forecast
from masonry.laboratory.moved_text import moved_lines
from masonry.laboratory.quality import cells_text, quality_lines
from masonry.laboratory.remarks.checks.unit_weight_densities import unit_weights
from masonry.laboratory.remarks.remark_catalogue import doubts_of_run, remarks_of_check
from masonry.laboratory.result import Result
from masonry.laboratory.settling_search import settled
from masonry.laboratory.summary.provenance import provenance_of
from masonry.laboratory.summary.run_summary import add_tilt, summarise
from masonry.laws.law_dispatch import word_of
from masonry.model.damping import damping_words, swing_of
from masonry.results.data import properties_by_group
from masonry.results.joint_resultants import resultants
from masonry.rows.rest_criterion import SETTLED
from masonry.runtime.processors import Seconds
from masonry.scene import Scene, to_toml
from masonry.timeloop import timeloop
from masonry.timeloop.checkpointer import Checkpointer
from masonry.timeloop.compiling import prepare
from masonry.timeloop.run_outcome import Outcome
from masonry.timeloop.threads import threads_for

if TYPE_CHECKING:
    from masonry.laboratory.text import Report

Progress = Callable[[int, int, str], None]

FREQUENCIES = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
"""Hz, at which `check` tells the damping ratio."""


def run(
    scene: Scene, threads: int | str = 1, progress: Progress | None = None, checkpointer: Checkpointer | None = None
) -> Result:
    """Run a scene to its end; `progress(step, steps, note)` is called between chunks. threads: a number or AUTO.

    Raises SceneError or GeometryError before anything is computed, Stopped (with `.result`, the rows up to the last
    trusted one) when the numbers can no longer be trusted. Ctrl-C ends the run; the result says so.

    Where the scene has dead loads and does not say how many steps they settle in, this is found first; the scene that
    the result holds has the number.

    checkpointer  writes checkpoints, goes on from one, and says when to end, in place of Ctrl-C
    """
    require_axles_to_load(scene)
    if progress is not None:
        progress(0, 0, "building the specimen")
    assembly = assemble(scene)
    threads, compiling, settling = threads_for(assembly.model, threads), Seconds(), Seconds()
    if scene.has_dead_loads and scene.settle is None:
        compiling = prepare(assembly.model, threads, progress)
        begun = Seconds.now()
        assembly = settled(
            assembly, threads, progress, checkpointer.asked if checkpointer is not None else lambda: False
        )
        settling = Seconds.now() - begun
        if checkpointer is not None:
            toml = to_toml(assembly.scene)
            checkpointer.run_another(toml, provenance_of(toml))
    outcome = timeloop.run(assembly.model, assembly.plan, assembly.recording, threads, progress, checkpointer)
    outcome.seconds_compile += compiling
    outcome.seconds_run += settling
    result = result_of(assembly, outcome)
    if outcome.stopped:
        stop = Stopped(outcome.stopped)
        stop.result = result
        raise stop
    return result


def result_of(assembly: Assembly, outcome: Outcome) -> Result:
    """Result that is kept of a run."""
    add_tilt(assembly, outcome)
    doubts = doubts_of_run(Inspection(assembly, outcome))
    summary = summarise(assembly, outcome) | {"warnings": [doubt.line for doubt in doubts]}
    return Result(
        summary=summary | judge(summary, doubts).as_keys(),
        history=outcome.history,
        specimen=assembly.specimen,
        joints=assembly.joints,
        joint_group=assembly.model.group,
        joint_groups=assembly.model.group_names,
        joint_properties=properties_by_group(assembly.model.groups.properties),
        mesh=assembly.mesh,
        scene_toml=to_toml(assembly.scene),
        log=[
            *(f"cells: {cells_text(c)}" for c in assembly.specimen.cells),
            *(f"scatter: {line}" for line in scatter_lines(assembly)),
            *(f"mass: {line}" for line in added_masses(assembly)),
            *unit_weights(assembly.scene),
            *left_out(assembly),
            *outcome.log,
        ],
        resultants=resultants(assembly.specimen.blocks, assembly.joints, outcome.standing),
    )


def check(scene: Scene) -> "Report":
    """Report on a scene before a run: sizes, time step and its limits, expected steps and time, parts left out."""
    assembly = assemble(scene)
    model = assembly.model
    counts, run = np.bincount(model.group, minlength=len(model.group_names)), forecast(assembly)
    from masonry.laboratory.text import Report

    return Report(
        blocks=assembly.specimen.blocks.count,
        cells=[cells_text(report) for report in assembly.specimen.cells],
        scatter=scatter_lines(assembly),
        contacts={name: int(n) for name, n in zip(model.group_names, counts, strict=True)},
        contact_points=len(model.group),
        tets=0 if assembly.mesh is None else len(assembly.mesh.tets),
        freedoms=model.dofs,
        time_step_s=model.dt,
        limited_by=model.limited_by,
        quality=quality_lines(assembly),
        masses=added_masses(assembly),
        bars=bar_lines(assembly),
        slabs=slab_lines(assembly),
        quiet=quiet_lines(assembly),
        settling=settling_text(assembly),
        meeting=meeting_text(assembly),
        moved=moved_lines(assembly),
        ratios=ratio_lines(scene),
        steps=run.steps[0],
        steps_between=run.steps[1:],
        expected_seconds=run.seconds[0],
        seconds_between=run.seconds[1:],
        left_out=left_out(assembly),
        compiled=compiled(assembly),
        warnings=remarks_of_check(assembly),
    )


def added_masses(assembly: Assembly) -> list[str]:
    """A line for each mass that is added to blocks."""
    scene, specimen = assembly.scene, assembly.specimen
    materials = {group: material_of(scene, group) for group in specimen.blocks.groups}
    return added_mass_lines(scene, specimen, assembly.joints, materials)


def quiet_lines(assembly: Assembly) -> list[str]:
    """A line for each quiet boundary: what it answers with, and the wave that comes in."""
    scene, blocks = assembly.scene, assembly.specimen.blocks
    lines = []
    for k, quiet in enumerate(scene.quiet):
        chosen = select(assembly.specimen, assembly.joints, quiet.on, f"quiet.{k}.on")[0]
        groups = sorted({blocks.groups[group] for group in blocks.group[chosen].tolist()})
        pairs = [(group, impedance_of(scene, quiet, group)) for group in groups]
        words = ", ".join(
            f"rho c_p {z[0] * 1e-6:.4g} and rho c_s {z[1] * 1e-6:.4g} MPa s/m of '{group}'" for group, z in pairs
        )
        wave = (
            ""
            if quiet.wave is None
            else "; a wave comes in of "
            + ", ".join(
                f"up to {motion.peak_velocity:.4g} m/s along {axis}, twice that at a free end"
                for axis, motion in quiet.wave.motions.items()
            )
        )
        lines.append(f"'{quiet.on}': {words}{wave}")
    return lines


def settling_text(assembly: Assembly) -> str:
    """How long the dead loads settle; nothing without any."""
    if not assembly.scene.has_dead_loads:
        return ""
    if assembly.scene.settle is not None:
        return f"{assembly.plan.settle} steps, as the scene says"
    return (
        f"until less than {SETTLED.force:g} of the dead loads is unbalanced and nothing moves: how many steps this "
        f"takes is found as the run begins; {assembly.plan.settle} are counted here"
    )


def ratio_lines(scene: Scene) -> list[str]:
    """The damping ratio of a swing over its frequency, once dead loads have settled; nothing where a scene says nothing
    of it."""
    if scene.damping is None:
        return []
    swing = swing_of(scene.damping)
    return [f"{frequency:>5g} Hz  {100 * swing.ratio_at(frequency):.3g} %" for frequency in FREQUENCIES]


def meeting_text(assembly: Assembly) -> str:
    """Remark on pieces that may meet as blocks move, in large displacement; empty without it."""
    large = assembly.model.large
    if large is None:
        return ""
    count, bonds = candidates(large), int(large.near.search.alive.sum())
    bonded = f" ({bonds} that bonds hold {_are(bonds)} left out)" if bonds else ""
    return (
        f"{count} pair{'s' * (count != 1)} of {len(large.near.pieces.body)} convex pieces {_are(count)} near enough to "
        f"be looked at{bonded}; neighbours are found anew when two blocks may have come nearer by the skin of "
        f"{1e3 * large.near.search.skin[0]:.3g} mm"
    )


def _are(count: int) -> str:
    return "is" if count == 1 else "are"


def scatter_lines(assembly: Assembly) -> list[str]:
    """Values that were drawn, a line for each property that scatters."""
    return [line for drawn in assembly.drawn for line in drawn.lines()]


def left_out(assembly: Assembly) -> list[str]:
    """Features that this scene does not use, and the step compiled for it therefore does not contain."""
    m, bodies = assembly.model, [body for body in assembly.model.bodies if body is not None]
    loaded = any(body.load is not None for body in bodies)
    kinds = zip(("rigid blocks", "affine blocks", "tets"), m.bodies, strict=True)
    absent = {
        **{f"{kind}: no such loops, no such degrees of freedom": body is None for kind, body in kinds},
        "dead loads (gravity, traction): no load arrays, no work": not loaded,
        "loads that vary: dead loads stay as they are": loaded and not m.varying,
        "damping": m.damping is None and (m.phases is None or m.phases.swinging is None),
        "drive": all(drive is None for drive in m.drives),
        "expected motion: a drive at a rate or in steps does not need it": all(body.guess is None for body in bodies),
        **{line: True for line in _left_out_of_contacts(assembly)},
        "scatter: all contacts of a group have the same properties": not assembly.drawn,
        "turned principal axes": all(getattr(body, "axes", None) is None for body in bodies),
    }
    return [words for words, is_absent in absent.items() if is_absent]


def _left_out_of_contacts(assembly: Assembly) -> list[str]:
    """A line for each group of contacts whose law lacks something."""
    lines = []
    for name, joint in zip(assembly.model.group_names, assembly.model.groups.properties, strict=True):
        options = {
            "dilation": joint.tan_dilation,
            "plastic opening": joint.elastic_unloading,
            "shared loss of tension and cohesion": joint.combined,
        }
        lacks = [words for words, value in options.items() if value is None]
        if joint.tensile_strength is None:
            lacks = ["strength", "softening", "history"]
        if lacks:
            lines.append(f"contacts {name}: no {', no '.join(lacks)}")
    return lines


def compiled(assembly: Assembly) -> list[str]:
    """Features that the step does contain."""
    m = assembly.model
    names = [f"{len(v)} {k} blocks" for k, v in m.layout.members.items() if len(v)]
    laws = []
    for g, (name, parameters) in enumerate(zip(m.group_names, m.groups.parameters, strict=True)):
        laws.append(f"{name}: {f'{word_of(parameters)} law' if g in m.swept else 'friction in patches, found anew'}")
    scene = assembly.scene
    damping = [damping_words(m.damping)] if scene.settles or not scene.swings else []
    damping += [f"{swing_of(scene.damping).words} once dead loads have settled"] if scene.swings else []
    return [*names, *laws, *damping, "energy ledger"]
