"""Description of a run: the scene, its sizes, and the course of its steps."""

from dataclasses import asdict

from masonry import __version__
from masonry.assembly.assemble import Assembly
from masonry.jit.sources import source_hash
from masonry.laboratory.summary.provenance import own_sources
from masonry.results.summary import Course, Description
from masonry.scene import Scene
from masonry.scene.tables.limit import LEFT_OUT
from masonry.timeloop.run_outcome import Outcome


def description(assembly: Assembly) -> Description:
    """The scene, and what its specimen consists of."""
    scene, model, specimen = assembly.scene, assembly.model, assembly.specimen
    laws = {name: scene.contact_of(name).law for name in model.group_names}
    kinematics = {group: scene.kinematics_of(group) for group in specimen.blocks.groups}
    return Description(
        scene=scene.name,
        law=_joined(laws),
        kinematics=_joined(kinematics),
        law_by_group=laws,
        kinematics_by_group=kinematics,
        blocks=specimen.blocks.count,
        cells=[asdict(report) for report in specimen.cells],
        scatter={drawn.group: drawn.summary() for drawn in assembly.drawn},
        contacts=len(model.group),
        tets=0 if assembly.mesh is None else len(assembly.mesh.tets),
        freedoms=model.dofs,
        section_m2=specimen.section,
        left_out=_left_out(scene),
        version=__version__,
        source_hash=_sources(scene),
    )


def course(assembly: Assembly, outcome: Outcome) -> Course:
    """Steps and seconds, and how the run ended."""
    return Course(
        steps=outcome.steps,
        control=outcome.loading.control(),
        seconds_run=outcome.seconds_run.wall,
        seconds_compile=outcome.seconds_compile.wall,
        seconds_processor_run=outcome.seconds_run.processor,
        seconds_processor_compile=outcome.seconds_compile.processor,
        time_step_s=assembly.model.dt,
        step_fraction=assembly.scene.solver.step_fraction,
        interrupted=outcome.interrupted,
        stopped=outcome.stopped,
    )


def _left_out(scene: Scene) -> str:
    """The load of [limit] where runs leave it out on purpose, else nothing."""
    limit = scene.limit
    if limit is None or limit.accuracy != LEFT_OUT:
        return ""
    return limit.words if scene.vehicle is None else scene.vehicle.words


def _joined(words: dict[str, str]) -> str:
    """One word where all agree, else all that occur: "elastic + exponential"."""
    return " + ".join(sorted(set(words.values())))


def _sources(scene: Scene) -> str:
    """Hash of our sources; behind a plus that of other packages, where the scene has a law of them."""
    own = own_sources(contact.law for contact in scene.contact.values())
    return f"{source_hash()}+{own}" if own else source_hash()
