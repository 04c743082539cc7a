"""Looks at the machine: is everything there that a run needs, and is what it computes right?"""

import importlib
import platform
import shutil
import textwrap
from collections.abc import Callable
from functools import partial
from typing import Any

from masonry import __version__
from masonry.cli.installed import COMPUTING, Finding, cached_code, module, others, processor, system, threading_layer
from masonry.runtime.tables import WIDTH

LEAST_FREE = 200e6
"""Bytes of free disk under which a run may not find room for its results."""
SELF_TEST = "verification.self_test"
"""Stands on a floor above this one: known by name alone, as the commands of other floors."""
USUAL: dict[str, dict[str, Any]] = {
    **{name: {} for name in ("couplet", "wallette-mode-1", "column-pushed", "wall-tilted", "shear-wall")},
    **{name: {} for name in ("block-rocking", "couplet-slid-off")},
    "couplet of tets": {"kinematics": "tets"},
}
"""Scenes whose steps have the parts of most others, with what is set anew in them; the first word names the scene."""
MARGIN = max(map(len, ("optional packages", "tension-exponential"))) + 2


def diagnose(quick: bool = False, say: Callable[[str], object] = print) -> bool:
    """Whether all is fine; each finding is said as a line. `quick` leaves out the self-test of ten seconds."""
    checks: dict[str, Callable[[], Finding]] = {
        "python": lambda: (True, platform.python_version()),
        "masonry": lambda: (True, __version__),
        "system": system,
        "processors": processor,
        **{name: partial(module, name) for name in COMPUTING},
        "threading layer": threading_layer,
        "other packages": lambda: others(optional=False),
        "optional packages": lambda: others(optional=True),
        "compiled code": cached_code,
        "free disk here": _disk,
    }
    fine = True
    for name, check in checks.items():
        good, words = check()
        fine = fine and good
        say(_line(name, words if good else f"PROBLEM: {words}"))
    if not quick:
        fine = self_tested(say) and fine if fine else _not_tested(say)
    say("all fine" if fine else "some things are missing or wrong, see above")
    return fine


def _line(name: str, words: str) -> str:
    return textwrap.fill(words, WIDTH, initial_indent=f"{name:<{MARGIN}}", subsequent_indent=" " * MARGIN)


def _disk() -> Finding:
    free = shutil.disk_usage(".").free
    return free > LEAST_FREE, f"{free / 1e9:.1f} GB"


def self_tested(say: Callable[[str], object]) -> bool:
    """A few runs whose answers are known without this program, and the speed."""
    try:
        findings = importlib.import_module(SELF_TEST).findings
    except ModuleNotFoundError as error:
        if error.name not in (SELF_TEST, SELF_TEST.partition(".")[0]):
            raise
        say(_line("self-test", f"not run: the package {SELF_TEST.partition('.')[0]} is not installed"))
        return True
    say(_line("self-test", "ten seconds; longer where the step has to be compiled first"))
    fine = True
    for name, good, lines in findings():
        fine = fine and good
        for number, words in enumerate(lines):
            say(_line(name if number == 0 else "", f"{'OK' if good else 'FAILED'}: {words}"))
    return fine


def warm(say: Callable[[str], None]) -> None:
    """Have the steps of usual scenes compiled, as far as they are not yet; says each as it is there."""
    from masonry.assembly.assemble import assemble
    from masonry.runtime.progress import ProgressLines
    from masonry.scene import load
    from masonry.timeloop.compiling import prepare

    lines = ProgressLines(USUAL, say)
    for name, settings in USUAL.items():
        seconds = prepare(assemble(load(name.partition(" ")[0], settings)).model, 1, None).wall
        lines.ended(name, "there", seconds)


def _not_tested(say: Callable[[str], object]) -> bool:
    say(_line("self-test", "not run until the problems above are solved"))
    return False
