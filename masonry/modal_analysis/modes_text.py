"""Modes in words, for a terminal."""

from masonry.modal_analysis.modes_data import ModesData
from masonry.runtime.tables import Rows, aligned, columns

HEADS = ("mode", "frequency", "period", "mass along x", "along y", "along z")


def result_text(result: ModesData) -> str:
    """Text that `masonry modes` prints."""
    notes = note_rows(result)
    table = "\n".join(columns(mode_table(result), right=range(len(HEADS))))
    return "\n".join(part for part in (aligned(head_rows(result)), table, aligned(notes) if notes else "") if part)


def head_rows(result: ModesData) -> Rows:
    """A word and its lines for each row above the table of modes."""
    closed = int(result.closed.sum())
    some = f"{closed} of {len(result.closed)}" if closed < len(result.closed) else f"all {closed}"
    return [
        ("scene", [result.title]),
        ("assumed", [result.assumed]),
        ("size", [f"{result.dofs} degrees of freedom, {some} contacts closed; in {result.seconds:.2f} s"]),
        ("mass", [_mass(result)]),
    ]


def note_rows(result: ModesData) -> Rows:
    """Those below it."""
    return [*_damping(result), *([("mind", result.remarks)] if result.remarks else [])]


def _mass(result: ModesData) -> str:
    x, y, z = result.mass.tolist()
    if max(x, y, z) - min(x, y, z) <= 1e-9 * max(x, y, z):
        return f"{x:.6g} kg can move"
    return f"{x:.6g} kg can move along x, {y:.6g} kg along y, {z:.6g} kg along z"


def mode_table(result: ModesData) -> list[list[str]]:
    """The table of modes, its heads first."""
    if not len(result.frequencies):
        return [list(HEADS)]
    rows = [
        [f"{number}", f"{frequency:.6g} Hz", f"{1.0 / frequency:.4g} s", *(f"{100.0 * x:.2f} %" for x in share)]
        for number, (frequency, share) in enumerate(
            zip(result.frequencies.tolist(), result.share.tolist(), strict=True), start=1
        )
    ]
    together = [f"{100.0 * x:.2f} %" for x in result.share.sum(axis=0)]
    return [list(HEADS), *rows, ["", "", "together", *together]]


def _damping(result: ModesData) -> Rows:
    """Rayleigh's two numbers."""
    if (numbers := result.rayleigh) is None:
        return []
    first, second = result.between
    where = f"modes {first} and {second}" if first != second else f"mode {first}, least there"
    return [
        (
            "damping",
            [f"{100.0 * result.ratio:g} % at {where} is a0 = {numbers[0]:.6g} 1/s, a1 = {numbers[1]:.6g} s (Rayleigh)"],
        )
    ]
