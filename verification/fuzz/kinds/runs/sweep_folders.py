"""Folders of sweeps whose runs are done: summaries, curves and copies of the sweep file that are damaged."""

from functools import cache
from pathlib import Path
from random import Random

from verification.fuzz.inputs import made_up, texts
from verification.fuzz.inputs.odd import one_of, paths
from verification.fuzz.kind import Attempt, Kind
from verification.fuzz.kinds.runs.results import summary

SWEEP = 'scene = "couplet"\n[grid]\n"contact.unit_unit.cohesion" = ["0.6 MPa", "0.8 MPa"]\n'


def make(draw: Random, folder: Path) -> Attempt:
    """A changed folder of a sweep, to be finished."""
    (folder / "s.toml").write_text(SWEEP, encoding="utf-8")
    out = folder / "out"
    for key in _keys():
        run = out / "runs" / key
        run.mkdir(parents=True)
        for name, content in made_up.files().items():
            (run / name).write_bytes(content)
    (out / "sweep.toml").write_text(SWEEP, encoding="utf-8")
    run = out / "runs" / _keys()[0]
    kind = draw.randrange(6)
    if kind < 2:
        (run / "summary.json").write_bytes(summary(draw, made_up.files()["summary.json"]))
    elif kind == 2:
        (run / "curve.csv").write_bytes(texts.changed_text(draw, made_up.files()["curve.csv"]))
    elif kind == 3:
        (run / "failure.json").write_bytes(summary(draw, b'{"status": "STOPPED", "reason": "x", "seconds": 1.0}'))
    elif kind == 4:
        (out / "sweep.toml").write_bytes(texts.changed_text(draw, SWEEP.encode()))
    else:
        place = one_of(
            draw, (run / "summary.json", run / "curve.csv", run / "failure.json", out / "sweep.toml", out / ".lock")
        )
        place.unlink(missing_ok=True)
        odd = one_of(draw, [path for path in paths(folder) if path and "\0" not in path and len(path) < 200])
        place.symlink_to(folder / odd)
    return Attempt(["sweep", "s.toml", "--out", "out"], ("out",), ("out/.lock", "out/sweep.toml"))


@cache
def _keys() -> list[str]:
    from masonry.sweep.job import Job

    return [Job("couplet", {"contact.unit_unit.cohesion": value}).key() for value in ("0.6 MPa", "0.8 MPa")]


KIND = Kind("sweep-folders", "folders of sweeps: summaries, curves, copies", 0.5, make)
