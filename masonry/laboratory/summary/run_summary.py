"""The summary of a run: one part after another, from an assembly and the outcome of its run."""

from masonry.assembly.assemble import Assembly
from masonry.assembly.schedule import tilt_at
from masonry.laboratory.summary.cracks import cracks, released_by, sudden_cracks
from masonry.laboratory.summary.description import course, description
from masonry.laboratory.summary.energies import energies
from masonry.laboratory.summary.extremes import extremes
from masonry.laboratory.summary.forces import forces
from masonry.laboratory.summary.measurements.elements_at_work import elements_at_work
from masonry.laboratory.summary.movements import movements
from masonry.laboratory.summary.rest import rest
from masonry.laboratory.summary.scales import scales_of
from masonry.results.summary import Summary
from masonry.rows.columns import TILT
from masonry.timeloop.run_outcome import Outcome


def summarise(assembly: Assembly, outcome: Outcome) -> Summary:
    """All parts but the judgement, in SI."""
    scales = scales_of(assembly.scene, assembly.model, assembly.plan, assembly.specimen.section, outcome)
    sudden = sudden_cracks(assembly, outcome, scales)
    return Summary(
        **description(assembly),
        **course(assembly, outcome),
        **extremes(assembly, outcome, scales),
        **forces(assembly, outcome, scales),
        **energies(assembly, outcome, scales, released_by(sudden)),
        **rest(assembly, outcome),
        **cracks(assembly, outcome, scales, sudden),
        **movements(assembly, outcome),
        **elements_at_work(assembly),
    )


def add_tilt(assembly: Assembly, outcome: Outcome) -> None:
    """The column of how far gravity is turned (rad), where it is."""
    rows = outcome.history.rows
    tilt = tilt_at(assembly.scene, assembly.plan, rows["step"])
    if tilt is not None:
        rows[TILT] = tilt
