"""One bad input, tried: what the program said, what it did besides, and whether any of it is a fault."""

import contextlib
import faulthandler
import os
import sys
import time
import traceback
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from masonry.runtime.shell import OK, STOPPED, USAGE
from verification.fuzz import memory
from verification.fuzz.inputs.odd import FORGED, LEAK
from verification.fuzz.kind import Attempt, Kind
from verification.fuzz.room import Room, differences, listing

MEMORY = 3 << 30
"""Bytes of real memory that a process may take for an input; readers of foreign files have a limit of their own."""
HANG = 30.0
"""Seconds after which an input counts as one that hangs: its process writes down where it is, and ends."""
LONGEST, MOST_LINES = 4000, 40
"""Letters and lines of what is said against an input."""
ERRORS = "strict", "backslashreplace"
"""What Python does with letters that cannot be written, to standard output and error."""
NOT_HELD = 1
"""`masonry verify --compare` and `doctor` end so where something is wrong with what they looked at."""


@dataclass(frozen=True)
class Trial:
    """What came of one input; `faults` are sentences, none where all is well. memory in bytes, code an exit code."""

    kind: str
    number: int
    code: int
    seconds: float
    memory: int
    said: str = ""
    faults: list[str] = field(default_factory=list)


def tried(kind: Kind, draw: Random, number: int, room: Room) -> Trial:
    """Make the input in a folder of its own, call the program, and look at what it left."""
    folder = room.enter(f"{kind.name}-{number}")
    attempt = kind.make(draw, folder)
    before, alive = listing(folder), memory.children()
    memory.forget_peak()
    begun = time.perf_counter()
    with open(f"{folder}.stack", "w", encoding="utf-8") as stack, _caught(room) as said:
        faulthandler.dump_traceback_later(HANG, file=stack, exit=True)
        room.folder = folder
        code = _call(attempt)
        room.folder = None
        faulthandler.cancel_dump_traceback_later()
    seconds, peak = time.perf_counter() - begun, memory.peak()
    out, err = said
    faults = [*_said_wrong(code, out, err), *room.seen, *room.left_over()]
    writes = attempt.when_refused if code == USAGE else attempt.writes
    faults += [f"outside: {name}" for name in differences(before, listing(folder), writes)]
    faults += [f"left running: process {number}" for number in memory.children() - alive]
    if peak > MEMORY:
        faults.append(f"took {peak / 1e9:.2g} GB of memory")
    room.leave(folder, keep=bool(faults))
    Path(f"{folder}.stack").unlink()
    return Trial(kind.name, number, code, seconds, peak, err.strip()[:LONGEST], faults)


def _call(attempt: Attempt) -> int:
    from masonry.cli.main import main

    try:
        return main(attempt.words)
    except BaseException:  # also SystemExit: the program returns its exit code
        traceback.print_exc()
        return -1


def _said_wrong(code: int, out: str, err: str) -> list[str]:
    faults = []
    if code not in (OK, NOT_HELD, USAGE, STOPPED):
        faults.append(f"exit code {code}")
    if "Traceback" in err:
        faults.append(f"traceback: {err.strip().splitlines()[-1][:200]}")
    elif code in (USAGE, STOPPED) and not any(line.startswith("masonry: ") for line in err.splitlines()):
        faults.append(f"no message: {err[:200]!r}")
    if len(err) > LONGEST or err.count("\n") > MOST_LINES:
        faults.append(f"a message of {len(err)} letters in {err.count(chr(10))} lines")
    odd = {c for c in out + err if not c.isprintable() and c != "\n"}
    if odd:
        faults.append(f"control characters are shown: {sorted(odd)!r:.80}")
    if any(line.lstrip().startswith(FORGED) for line in (out + err).splitlines()):
        faults.append("a name looks like a line of its own")
    if LEAK in out + err:
        faults.append("the words of a file of others are repeated")
    if "Warning:" in err:
        faults.append(f"a warning of a package: {err[:300]!r}")
    return faults


@contextlib.contextmanager
def _caught(room: Room) -> Iterator[list[str]]:
    """What is written to standard output and error within, by native code too; filled at the end."""
    said: list[str] = []
    paths = [room.root / f"said-{n}" for n in (1, 2)]
    flows = []
    for path, how in zip(paths, ERRORS, strict=True):
        flows.append(open(path, "w", encoding="utf-8", errors=how))  # noqa: SIM115
    kept, streams = [os.dup(n) for n in (1, 2)], (sys.stdout, sys.stderr)
    for stream in streams:
        stream.flush()
    for n, flow in enumerate(flows, start=1):
        os.dup2(flow.fileno(), n)
    sys.stdout, sys.stderr = flows
    try:
        yield said
    finally:
        sys.stdout, sys.stderr = streams
        for n, (flow, usual) in enumerate(zip(flows, kept, strict=True), start=1):
            with contextlib.suppress(UnicodeError):
                flow.close()
            os.dup2(usual, n)
            os.close(usual)
        for path in paths:
            with open(path, encoding="utf-8", errors="replace", newline="\n") as file:
                said.append(file.read(10_000_000))
