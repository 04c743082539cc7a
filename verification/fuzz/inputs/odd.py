"""Odd values to put where a sound one stood: numbers, quantities, texts, paths."""

from collections.abc import Sequence
from pathlib import Path
from random import Random
from typing import Any, TypeVar

T = TypeVar("T")
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
    *(
        "9**9**9 mm",
        "5 mm " * 30,
        "1" * 100_000 + " mm",
        "5 count",
        "5 e^2",
        "1e-999 m",
        "5 \u2126m",
        "5 m/m/m/m",
        "5 %",
    ),
    *(
        "__import__('os') m",
        "5 mm; 6 mm",
        "+5 mm",
        "--5 mm",
        ".5 mm",
        "5. mm",
        "5e mm",
        "5 mm\n",
        "5 \u200bmm",
        "5 m^-9",
    ),
)
TEXTS = (
    *(
        "",
        " ",
        "\n",
        f"a\n{FORGED}: all is well",
        f"a\r\n{FORGED}",
        f"\x1b[2J\x1b[31m{FORGED}",
        "\x00",
        "a\x00b",
        "\x7f",
    ),
    *("\u202egnirts", "\u2028x", "\x85", "\ud800", "a\udcffb", "\ufeffx", "e\u0301" * 50, "\U0001f9f1", "a" * 300),
    *("b" * 100_000, "a b", "a.b", "a]b", "[x]", "'", '"', "\\", "/", "..", "../..", "~", "-", "--help", "$x$", "%s%n"),
    *("{0}", "${HOME}", "`id`", "; rm -rf /", "=", "#", "units", "top", "default", "all", "null", "true", "0", "-1"),
    *("x = 0 mm", "blocks at z = nan mm", "units.z-", "top.z+.z+", "z = 1e400 mm", "blocks at", "top and bottom"),
)


def secret_in(folder: Path) -> Path:
    """A file with words that must not be repeated."""
    path = folder / "shadow"
    path.write_text(SECRET, encoding="utf-8")
    return path


def paths(folder: Path) -> tuple[str, ...]:
    """Places that are no sound file, some of them made in this folder."""
    import os

    (folder / "folder.toml").mkdir(exist_ok=True)
    for name, target in (("loop.toml", "loop.toml"), ("nowhere.toml", "no-such-file"), ("zero.toml", "/dev/zero")):
        if not (folder / name).is_symlink():
            os.symlink(target, folder / name)
    if not (folder / "pipe.toml").exists():
        os.mkfifo(folder / "pipe.toml")
    (folder / "empty.toml").write_bytes(b"")
    return (
        *("folder.toml", "loop.toml", "nowhere.toml", "zero.toml", "pipe.toml", "empty.toml", str(secret_in(folder))),
        *("/dev/zero", "/dev/null", "/dev/stdin", "/dev/random", "/etc/passwd", "/proc/self/mem", "/proc/kmsg", "/"),
        *("..", ".", "", "../../../../etc/shadow", "a" * 300, "a/" * 3000, "x\x00y", "\udcff.toml", "no/such/folder/x"),
        *("//", "http://127.0.0.1/x", "file:///etc/passwd", "~root", "COM1", "a\nb", "*", "-", "|id"),
    )


def one_of(draw: Random, values: Sequence[T]) -> T:
    """Any of them."""
    return values[draw.randrange(len(values))]


def value(draw: Random) -> Any:
    """Anything that TOML or JSON can hold."""
    kind = draw.randrange(8)
    if kind < 2:
        return one_of(draw, NUMBERS)
    if kind < 4:
        return one_of(draw, QUANTITIES)
    if kind < 6:
        return one_of(draw, TEXTS)
    if kind == 6:
        return [value(draw) for _ in range(draw.randrange(4))]
    return {one_of(draw, (*TEXTS[:40], "kind", "x", "times")): value(draw) for _ in range(draw.randrange(3))}
