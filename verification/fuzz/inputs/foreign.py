"""Files of other programs as `masonry import` is given them."""

from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

from verification.fuzz.inputs.odd import SECRET, one_of
from verification.fuzz.inputs.texts import changed_bytes, changed_text
from verification.fuzz.kind import Attempt

Change = Callable[[Random, bytes], bytes]
WORDS: tuple[tuple[str, ...], ...] = (
    (),
    (),
    (),
    ("--unit", "mm"),
    ("--open-gaps",),
    ("--group", "*=wall"),
    ("--section", "1 cm^2"),
    ("--tolerance", "1 m"),
    ("--thickness", "5 cm"),
)


def importing(
    draw: Random, folder: Path, seeds: Sequence[bytes], suffixes: Sequence[str], special: Sequence[Change] = ()
) -> Attempt:
    """One of the files, changed as text, as bytes, or in a way of its format, and the call that imports it."""
    content = one_of(draw, seeds)
    if special and draw.random() < 0.3:
        content = one_of(draw, special)(draw, content)
    elif draw.random() < 0.02:
        content = SECRET.encode()
    elif draw.random() < 0.6:
        content = changed_text(draw, content)
    else:
        content = changed_bytes(draw, content)
    name = f"a{one_of(draw, suffixes)}"
    (folder / name).write_bytes(content)
    words = ["import", name, "--out", "new.toml", *one_of(draw, WORDS)]
    if suffixes[0] == ".tess" and "--thickness" not in words and draw.random() < 0.5:
        words += ["--thickness", "5 cm"]
    return Attempt(words, ("new.toml", "new.blocks.h5"))
