"""Every file of `scenes/`, `runs/` and `checks/`, asked without a list."""

from masonry.assembly.assemble import Assembly
from masonry.estimates.inspection import Inspection
from masonry.judgement.catalogue import modules_of
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks import checks, runs, scenes


def doubts_of_scene(assembly: Assembly) -> list[Doubt]:
    """Doubts about a scene before a run."""
    return [doubt for module in modules_of(scenes) for doubt in module.doubts(assembly)]


def doubts_of_run(inspection: Inspection) -> list[Doubt]:
    """Doubts from frames and rows, and those from before the run."""
    measured = [doubt for module in modules_of(runs) for doubt in module.doubts(inspection)]
    return [*doubts_of_scene(inspection.assembly), *measured]


def remarks_of_check(assembly: Assembly) -> list[str]:
    """Warnings of `masonry check`, a line each."""
    alone = [line for module in modules_of(checks) for line in module.remarks(assembly)]
    return [*(doubt.line for doubt in doubts_of_scene(assembly)), *alone]
