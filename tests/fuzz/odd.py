"""Odd values to put where a sound one stood: numbers, quantities, texts, paths; and how one of them is drawn."""

import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

import h5py
import numpy as np
from hypothesis import strategies as st

T = TypeVar("T")
Draw = st.DrawFn
SECRET = "root:$6$fuzzsecretsalt$fuzzsecrethash:19000:0:99999:7:::\ndaemon:*:19000:0:99999:7:::\n"
"""What stands in a file that only its owner should see."""
LEAK = "fuzzsecret"
"""No message may repeat it."""
FORGED = "masonry-fuzz-forged-line"
"""No line of what is said may begin with it: a name with a newline must not look like a message of its own."""
NUMBERS: tuple[Any, ...] = (
    *(0, -1, 1, 2, 3, 7, 255, 256, 65536, 2**31 - 1, 2**31, 2**32, 2**63 - 1, 2**63, 2**64, 10**18, 10**30, 10**400),
    *(-(2**31), -(2**63), -(10**400), 0.0, -0.0, 0.5, 1.5, 1e-300, 5e-324, 1e-12, 1e12, 1e300, 1.8e308, -1e300),
    *(float("nan"), float("inf"), float("-inf"), True, False),
)
QUANTITIES = (
    *("1e999 MPa", "nan m", "inf m", "-5 mm", "0 m", "1e-300 m", "1e300 m", "5 m/s", "5", "5 mm^99", "5 m*m*m*m*m*m*m"),
    *("\u0663 mm", "1,5 mm", "1_000 mm", "5 \u00b5m", "", " ", "mm", "5 dB", "5 degC", "0x10 mm", "1e5000 mm"),
    *("9**9**9 mm", "5 mm " * 30, "1" * 100_000 + " mm", "5 count", "5 e^2", "1e-999 m", "5 \u2126m", "5 m/m/m/m"),
    *("__import__('os') m", "5 mm; 6 mm", "+5 mm", "--5 mm", ".5 mm", "5. mm", "5e mm", "5 mm\n", "5 \u200bmm", "5 %"),
    "5 m^-9",
)
TEXTS = (
    *("", " ", "\n", f"a\n{FORGED}: all is well", f"a\r\n{FORGED}", f"\x1b[2J\x1b[31m{FORGED}", "\x00", "a\x00b"),
    *("\x7f", "\u202egnirts", "\u2028x", "\x85", "\ud800", "a\udcffb", "\ufeffx", "e\u0301" * 50, "\U0001f9f1"),
    *("a" * 300, "b" * 100_000, "a b", "a.b", "a]b", "[x]", "'", '"', "\\", "/", "..", "../..", "~", "-", "--help"),
    *("$x$", "%s%n", "{0}", "${HOME}", "`id`", "; rm -rf /", "=", "#", "units", "top", "default", "all", "null"),
    *("true", "0", "-1", "x = 0 mm", "blocks at z = nan mm", "units.z-", "top.z+.z+", "z = 1e400 mm", "blocks at"),
    "top and bottom",
)
NO_FILES = (
    *("folder.toml", "loop.toml", "nowhere.toml", "zero.toml", "pipe.toml", "empty.toml", "shadow"),
    *("/dev/zero", "/dev/null", "/dev/stdin", "/dev/random", "/etc/passwd", "/proc/self/mem", "/proc/kmsg", "/"),
    *("..", ".", "", "../../../../etc/shadow", "a" * 300, "a/" * 3000, "x\x00y", "\udcff.toml", "no/such/folder/x"),
    *("//", "http://127.0.0.1/x", "file:///etc/passwd", "~root", "COM1", "a\nb", "*", "-", "|id"),
)
"""Paths that are no sound file; `furnish` makes the first ones."""
TARGETS = [path for path in NO_FILES if path and "\0" not in path and len(path) < 200]
"""Those that a link can lead to."""


def furnish(folder: Path) -> None:
    """Put into a folder what may stand in the place of a sound file."""
    import os

    (folder / "folder.toml").mkdir()
    for name, target in (("loop.toml", "loop.toml"), ("nowhere.toml", "no-such-file"), ("zero.toml", "/dev/zero")):
        os.symlink(target, folder / name)
    os.mkfifo(folder / "pipe.toml")
    (folder / "empty.toml").touch()
    for name in ("shadow", "raw.bin"):
        (folder / name).write_text(SECRET * 20, encoding="utf-8")
    (folder / "other.h5").write_bytes(OTHER)


def _other() -> bytes:
    content = io.BytesIO()
    with h5py.File(content, "w") as file:
        file["x"] = np.arange(100.0)
    return content.getvalue()


OTHER = _other()
"""An HDF5 file that links of another one lead to."""


def pick(draw: Draw, values: Sequence[T]) -> T:
    """Any of them."""
    return draw(st.sampled_from(values))


def below(draw: Draw, count: int) -> int:
    """A number from 0, less than count."""
    return draw(st.integers(0, count - 1))


def chance(draw: Draw, percent: int) -> bool:
    """True in so many of a hundred draws."""
    return draw(st.integers(1, 100)) <= percent


ANY_VALUE = st.recursive(
    st.sampled_from(NUMBERS) | st.sampled_from(QUANTITIES) | st.sampled_from(TEXTS) | st.text(max_size=20),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from((*TEXTS[:40], "kind", "x", "times")), inner)
    ),
    max_leaves=5,
)
"""Anything that TOML or JSON can hold."""


def toml(tree: dict[str, Any]) -> str:
    """The tree as TOML: tables below the top are written inline."""
    return "".join(f"{_inline(str(key))} = {_inline(item)}\n" for key, item in tree.items())


def _inline(item: Any) -> str:
    if isinstance(item, dict):
        return "{" + ", ".join(f"{_inline(str(key))} = {_inline(below)}" for key, below in item.items()) + "}"
    if isinstance(item, list | tuple):
        return "[" + ", ".join(map(_inline, item)) + "]"
    if isinstance(item, bool):
        return str(item).lower()
    if isinstance(item, str):
        return json.dumps(item, ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(item)
