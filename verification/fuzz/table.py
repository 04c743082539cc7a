"""What came of a campaign as a table, one row a kind, and a list of the faults."""

from collections.abc import Iterable, Sequence

from masonry.runtime.shell import STOPPED, USAGE
from verification.fuzz.campaign import HUNG
from verification.fuzz.kind import all_kinds
from verification.fuzz.trial import Trial

HEADER = ("kind", "inputs", "accepted", "refused", "faults", "seconds", "longest [s]", "memory [MB]", "what is bad")
MOST = 40
"""Faults that are listed."""


def row(name: str, trials: Sequence[Trial]) -> tuple[str, ...]:
    """Of one kind."""
    bad = sum(bool(t.faults) for t in trials)
    refused = sum(t.code in (USAGE, STOPPED) and not t.faults for t in trials)
    what = all_kinds()[name].what if name in all_kinds() else ""
    return (
        *(name, f"{len(trials)}", f"{len(trials) - bad - refused}", f"{refused}", f"{bad}"),
        *(f"{sum(t.seconds for t in trials):.1f}", f"{max(t.seconds for t in trials):.2f}"),
        *(f"{max(t.memory for t in trials) / 1e6:.0f}", what),
    )


def table_text(trials: Sequence[Trial]) -> str:
    """All kinds, and a row for all together."""
    names = sorted({t.kind for t in trials})
    rows = [HEADER, *(row(name, [t for t in trials if t.kind == name]) for name in names), row("all", trials)]
    wide = [max(len(line[k]) for line in rows) for k in range(len(HEADER))]
    ends = len(HEADER) - 1
    return "\n".join(
        "  ".join(
            f"{word:<{w}}" if k in (0, ends) else f"{word:>{w}}"
            for k, (word, w) in enumerate(zip(line, wide, strict=True))
        ).rstrip()
        for line in rows
    )


def verdict(trials: Sequence[Trial], seconds: float) -> str:
    """The sentence that counts."""
    tracebacks = sum(any("traceback" in f or "exit code" in f for f in t.faults) for t in trials)
    hangs = sum(t.code == HUNG for t in trials)
    outside = sum(any(f.startswith(("outside", "open ", "os.", "left over")) for f in t.faults) for t in trials)
    others = sum(bool(t.faults) for t in trials) - tracebacks - hangs - outside
    return (
        f"{len(trials)} inputs in {seconds:.0f} s: {tracebacks} tracebacks, {hangs} hangs, {outside} files outside, "
        f"{max(others, 0)} other faults"
    )


def faults_text(trials: Iterable[Trial], seed: int) -> str:
    """The faults, and how to see each again."""
    bad = [t for t in trials if t.faults]
    lines = [f"{t.kind} {t.number}: {'; '.join(t.faults)[:500]}" for t in bad[:MOST]]
    if len(bad) > MOST:
        lines.append(f"... and {len(bad) - MOST} more")
    if bad:
        first = bad[0]
        lines.append(f"again: python -m verification.fuzz --seed {seed} --kind {first.kind} --only {first.number}")
    return "\n".join(lines)
