"""VTK's unstructured meshes: text, base64, raw; entities that grow, compressed bombs."""

import base64
import zlib
from pathlib import Path
from random import Random

from verification.fuzz.inputs import seeds
from verification.fuzz.inputs.foreign import importing
from verification.fuzz.inputs.odd import one_of
from verification.fuzz.kind import Attempt, Kind

LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10 if n else "ha"}">' for n in range(10))
BOMB = 300_000_000


def make(draw: Random, folder: Path) -> Attempt:
    """A changed mesh."""
    return importing(draw, folder, seeds.vtu(), (".vtu",), (_document, _encoding, _bomb, _claims))


def _document(draw: Random, content: bytes) -> bytes:
    """A document type: entities that grow without end, or that are files."""
    inner = one_of(
        draw, (LAUGHS, '<!ENTITY x SYSTEM "file:///etc/passwd">', '<!ENTITY % a SYSTEM "http://127.0.0.1/x">%a;', "")
    )
    start = f"<!DOCTYPE x [{inner}]>".encode()
    words = content.replace(b"Points", b"&l9;&x;", 1)
    return one_of(
        draw,
        (
            b'<?xml version="1.0"?>' + start + words,
            start + words,
            content + start,
            words.replace(b"?>", b"?>" + start, 1),
        ),
    )


def _encoding(draw: Random, content: bytes) -> bytes:
    """The same letters in an encoding that hides them."""
    name = one_of(draw, ("utf-16", "utf-16-le", "utf-32", "utf-7", "cp037", "latin-1", "utf-8-sig"))
    text = f"<!DOCTYPE x [{LAUGHS}]>" + content.decode("latin-1")
    return f'<?xml version="1.0" encoding="{name}"?>'.encode() * draw.randrange(2) + text.encode(name, "replace")


def _bomb(draw: Random, content: bytes) -> bytes:
    """Compressed zeros in the place of an array."""
    packed = zlib.compress(b"\0" * one_of(draw, (100_000, 10_000_000, BOMB)))
    head = b"".join(n.to_bytes(4, "little") for n in (1, one_of(draw, (32768, BOMB, 2**32 - 1)), 0, len(packed)))
    data = base64.b64encode(head) + base64.b64encode(packed)
    at = content.find(b">", content.find(b"<DataArray")) + 1
    return content[:at] + data + content[content.find(b"<", at) :]


def _claims(draw: Random, content: bytes) -> bytes:
    """More points and cells than there are."""
    return content.replace(
        b'NumberOfPoints="', b'NumberOfPoints="' + one_of(draw, (b"9", b"-", b"1e9", b"99999999999"))
    ).replace(b'NumberOfCells="', b'NumberOfCells="' + one_of(draw, (b"", b"9", b"-1")))


KIND = Kind("vtu", "VTK's meshes; entities, encodings, compressed bombs", 2.5, make)
