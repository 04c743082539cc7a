"""Scenes on scenes that are no files, torn, huge, or stand on themselves; specimens from files that are none."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs import seeds, texts
from verification.fuzz.inputs.odd import one_of, paths
from verification.fuzz.kind import Attempt, Kind

HUGE = 5_000_001


def make(draw: Random, folder: Path) -> Attempt:
    """A file, or a name in the place of a scene, of its base, or of its blocks."""
    odd = one_of(draw, paths(folder))
    kind = draw.randrange(6)
    file = folder / "a.toml"
    if kind == 0:
        return Attempt(["check", odd])
    if kind == 1:
        _write(file, f"base = {_quoted(odd)}\n")
    elif kind == 2:
        _write(file, f'base = "couplet"\n[specimen]\nkind = "file"\npath = {_quoted(odd)}\n')
    elif kind == 3:
        for n in range(1 + draw.randrange(12)):
            _write(folder / f"{n}.toml", f'base = "{one_of(draw, (str(n + 1), "0", str(n)))}.toml"\n')
        _write(file, 'base = "0.toml"\n')
    elif kind == 4:
        file.write_bytes(_large(draw))
    else:
        below = texts.changed_text(draw, one_of(draw, list(seeds.scenes().values())).encode())
        (folder / "below.toml").write_bytes(below)
        _write(file, f'base = "below.toml"\nlaw = {_quoted(one_of(draw, ("linear", "x", odd)))}\n')
    return Attempt(["check", "a.toml"])


def _large(draw: Random) -> bytes:
    """What takes a careless reader long, or much memory."""
    piece = one_of(
        draw,
        (
            b"a.",
            b"[",
            b"[[a]]\n",
            b"{a=",
            b"a = 1\n",
            b'"',
            b"'''",
            b"\\",
            b"#",
            b"[a.b.c]\n",
            b"x = [",
            b"\n",
            b"a = 1e",
            b"1",
            b"a.a.a.a.a = 1\n",
            b"\xff",
            b"a = '\n",
            b"[specimen]\n",
            b"0_",
        ),
    )
    count = one_of(draw, (1000, 30_000, HUGE)) // len(piece) + 1
    return one_of(draw, (b"", b"a = ", b'title = "', b"[support]\n")) + piece * count


def _quoted(text: str) -> str:
    import json

    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _write(path: Path, text: str) -> None:
    path.write_bytes(text.encode("utf-8", "surrogatepass"))


KIND = Kind("scene-files", "what a scene stands on: no file, torn, huge, a circle", 10, make)
