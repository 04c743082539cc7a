"""Files changed as text or as bytes: cut, repeated, with odd numbers in the place of sound ones."""

import re
import struct
from random import Random

from verification.fuzz.inputs.odd import QUANTITIES, TEXTS, one_of

NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
ODD = (
    b"nan",
    b"inf",
    b"-inf",
    b"0",
    b"-1",
    b"1e308",
    b"1e-320",
    b"1e999",
    b"2147483648",
    b"9223372036854775808",
    b"1000000000",
    b"999999999999999999999",
    b"1.5",
    b"",
    b"x",
    b"0x10",
    b"--1",
    b"1_0",
    b"\xd9\xa3",
)
LARGEST = 300_000
"""Bytes of what is made; repeated parts stop there."""


def changed_text(draw: Random, content: bytes) -> bytes:
    """One to three changes of a text file."""
    for _ in range(1 + draw.randrange(3)):
        content = _change(draw, content)
    return content[:LARGEST]


def _change(draw: Random, content: bytes) -> bytes:
    kind = draw.randrange(10)
    at = draw.randrange(len(content) + 1)
    lines = content.split(b"\n")
    n, m = draw.randrange(len(lines)), draw.randrange(len(lines))
    if kind == 0:
        return content[:at]
    if kind == 1:
        return content[:at] + content[at + draw.randrange(200) :]
    if kind == 2:
        lines[n], lines[m] = lines[m], lines[n]
    elif kind == 3:
        lines[n:n] = [lines[m]] * one_of(draw, (1, 2, 50, 1000))
    elif kind == 4:
        del lines[n : n + 1 + draw.randrange(5)]
    elif kind in (5, 6, 7):
        return with_other_number(draw, content)
    elif kind == 8:
        odd = one_of(draw, (*TEXTS, *QUANTITIES)).encode("utf-8", "surrogatepass")
        return content[:at] + odd + content[at:]
    else:
        return changed_bytes(draw, content)
    return b"\n".join(lines)


def with_other_number(draw: Random, content: bytes) -> bytes:
    """Another number in the place of one: odd, a thousand million times as large, negative, or another's."""
    found = list(NUMBER.finditer(content))
    if not found:
        return content
    one, other = one_of(draw, found), one_of(draw, found)
    new = one_of(draw, (one_of(draw, ODD), one[0] + b"000000000", b"-" + one[0], other[0], one[0] + b"1", b"3"))
    return content[: one.start()] + new + content[one.end() :]


def changed_bytes(draw: Random, content: bytes) -> bytes:
    """One change of a binary file."""
    data = bytearray(content)
    if not data:
        return b"\0"
    at = draw.randrange(len(data))
    kind = draw.randrange(7)
    if kind == 0:
        for _ in range(1 + draw.randrange(8)):
            data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)
    elif kind == 1:
        del data[at:]
    elif kind == 2:
        del data[at : at + 1 + draw.randrange(64)]
    elif kind == 3:
        data[at:at] = data[at : at + 1 + draw.randrange(256)] * one_of(draw, (1, 3, 100))
    elif kind == 4:
        number = one_of(draw, (0, 1, -1, 2**31 - 1, 10**9, 2**62, -(2**63)))
        data[at : at + 8] = struct.pack("<q", number)
    elif kind == 5:
        data[at : at + 4] = one_of(draw, (b"\xff" * 4, b"\0" * 4, b"\xff\xff\xff\x7f", b"\0\xca\x9a\x3b"))
    else:
        data[at : at + 8] = struct.pack("<d", one_of(draw, (float("nan"), float("inf"), 1e308, -1e300, 5e-324)))
    return bytes(data[:LARGEST])
