"""A search for bad input that is led by what code it reaches: atheris, which is libFuzzer for Python."""

import importlib.util
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from masonry.errors import SceneError, extra
from verification.fuzz.inputs import seeds
from verification.fuzz.kind import Kind, all_kinds, kind_of

MODULES = ["geometry", "masonry", "tomllib"]
"""What is watched."""
SLOWEST, MEMORY = 20, 3000
"""Seconds and MB that an input may take."""
LONGEST = 20_000
"""Bytes of an input."""


def search(kind: Kind, seconds: int) -> int:
    """Search for so long; 0 where nothing was found, else 1, and what breaks the reader is kept. Raises SceneError."""
    if kind.target is None:
        able = ", ".join(name for name, known in all_kinds().items() if known.target)
        raise SceneError(f"--atheris {kind.name}: only for readers in Python: {able}")
    if importlib.util.find_spec("atheris") is None:
        raise SceneError(f"--atheris needs the package atheris; {extra('fuzz')}")
    folder = Path(tempfile.mkdtemp(prefix="masonry-atheris-"))
    corpus = folder / "corpus"
    corpus.mkdir()
    for number, seed in enumerate(_seeds(kind.name)):
        (corpus / f"seed-{number}").write_bytes(seed)
    words = [f"-max_total_time={seconds}", f"-timeout={SLOWEST}", f"-rss_limit_mb={MEMORY}", f"-max_len={LONGEST}"]
    ran = subprocess.run(
        [
            sys.executable,
            "-m",
            "verification.fuzz.coverage",
            kind.name,
            *words,
            f"-artifact_prefix={folder}/",
            str(corpus),
        ],
        check=False,
    )
    if ran.returncode == 0:
        print(f"{kind.name}: nothing found in {seconds} s")
        return 0
    print(f"{kind.name}: what breaks the reader is in '{folder}'")
    return 1


def _seeds(name: str) -> tuple[bytes, ...]:
    """Sound files of this kind."""
    from verification.fuzz.inputs.trees import toml
    from verification.fuzz.kinds.runs import quantity, sweep

    known: dict[str, Callable[[], tuple[bytes, ...]]] = {
        "tess": seeds.tess,
        "step": seeds.step,
        "sweep": lambda: tuple(toml(tree).encode() for tree in sweep.SEEDS),
        "quantity": lambda: tuple(text.encode() for text in quantity.SEEDS),
    }
    return known.get(name, lambda: tuple(text.encode() for text in seeds.scenes().values()))()


def _serve(words: list[str]) -> None:
    """The process that searches; it ends itself."""
    import atheris

    with atheris.instrument_imports(include=MODULES):
        target = kind_of(words[1]).target
        assert target is not None
        target(_seeds(words[1])[0])
    atheris.Setup([words[0], *words[2:]], target)
    atheris.Fuzz()


if __name__ == "__main__":
    _serve(sys.argv)
