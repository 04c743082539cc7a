"""Files of other programs, as `masonry import` is given them, and files of blocks."""

import base64
import zlib
from collections.abc import Callable, Sequence
from functools import cache

from geometry.joints.find import find_joints
from masonry.importing.scene_file import Written, scene_text
from tests.fuzz import sound
from tests.fuzz.attempt import Attempt, kind
from tests.fuzz.changes import changed_bytes, changed_text
from tests.fuzz.hdf5 import changed_hdf5
from tests.fuzz.odd import SECRET, TEXTS, Draw, below, chance, pick

Change = Callable[[Draw, bytes], bytes]
WORDS: tuple[tuple[str, ...], ...] = (
    *((), (), (), ("--unit", "mm"), ("--open-gaps",), ("--group", "*=wall"), ("--section", "1 cm^2")),
    *(("--tolerance", "1 m"), ("--thickness", "5 cm")),
)
LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10 if n else "ha"}">' for n in range(10))
ENTITIES = (LAUGHS, '<!ENTITY x SYSTEM "file:///etc/passwd">', '<!ENTITY % a SYSTEM "http://127.0.0.1/x">%a;', "")
ENCODINGS = ("utf-16", "utf-16-le", "utf-32", "utf-7", "cp037", "latin-1", "utf-8-sig")
BOMB = 300_000_000
OTHER_ELEMENTS = (b" 5 2 ", b" 11 2 ", b" 2 2 ", b" 99 2 ", b" 4 0 ", b" 4 -1 ", b" 4 1000000000 ")
MSH_HEADS = (
    *(b"2.2 0 8", b"2.2 1 8", b"4.1 0 8", b"4.1 1 8", b"4.0 1 8", b"4.1 1 4", b"9 0 8", b"1 0 8", b"2.2 7 8", b""),
    *(b"x y z", b"2.2 0 99999999999"),
)
IN_NAMES = (b"", b"\\X2\\000A000D\\X0\\", b"\\X2\\D800\\X0\\", b"''", b"\\X\\1B[2J")


def _imported(
    draw: Draw,
    seeds: Sequence[bytes],
    suffixes: Sequence[str],
    special: Sequence[Change] = (),
    words: Sequence[str] = (),
) -> Attempt:
    """One of the files, changed as text, as bytes, or in a way of its format, and the call that imports it."""
    content = pick(draw, seeds)
    if special and chance(draw, 30):
        content = pick(draw, special)(draw, content)
    elif chance(draw, 2):
        content = SECRET.encode()
    else:
        content = (changed_text if chance(draw, 60) else changed_bytes)(draw, content)
    name = f"a{pick(draw, suffixes)}"
    more = [*pick(draw, WORDS), *words]
    return Attempt(["import", name, "--out", "new.toml", *more], {name: content}, ("new.toml", "new.blocks.h5"))


@kind("step", 2.5, 6)
def step(draw: Draw) -> Attempt:
    """STEP: torn, numbers that lie, references in circles, other letters in names."""
    return _imported(draw, sound.step(), (".step", ".stp"), (_names, _references, _circle))


def _names(draw: Draw, content: bytes) -> bytes:
    """Odd letters in the names of solids."""
    name = pick(draw, TEXTS).encode("utf-8", "surrogatepass") + pick(draw, IN_NAMES)
    for word in (b"MANIFOLD_SOLID_BREP('", b"PRODUCT('"):
        content = content.replace(word, word + name)
    return content


def _references(draw: Draw, content: bytes) -> bytes:
    """One reference led elsewhere."""
    parts = content.split(b"#")
    n = 1 + below(draw, len(parts) - 1)
    other = pick(draw, (b"1", b"0", b"999999", b"99999999999999999999", b"-1", b""))
    parts[n] = other + parts[n].lstrip(b"0123456789")
    return b"#".join(parts)


def _circle(draw: Draw, content: bytes) -> bytes:
    """Entities that stand on themselves, or for a thousand million others."""
    more = [
        f"#{900_000 + n} = NEXT_ASSEMBLY_USAGE_OCCURRENCE('','a','',#{n % 40 + 1},#{(n * 7) % 40 + 1},$);"
        for n in range(60)
    ]
    more += [f"#{800_000 + n} = CONVERSION_BASED_UNIT('X',#{800_000 + n});" for n in range(3)]
    return content.replace(b"ENDSEC;\nEND", "\n".join(more).encode() + b"\nENDSEC;\nEND")


@kind("iges-brep", 0.8, 4)
def iges_brep(draw: Draw) -> Attempt:
    """IGES and BREP files, changed as text and as bytes."""
    if chance(draw, 50):
        return _imported(draw, [sound.cad(".igs")], (".igs", ".iges"))
    return _imported(draw, [sound.cad(".brep")], (".brep",))


@kind("msh", 2.5, 8)
def msh(draw: Draw) -> Attempt:
    """Gmsh's meshes, 2.2 and 4.1, text and binary; other elements, versions and sizes of numbers."""
    return _imported(
        draw,
        sound.msh(),
        (".msh",),
        (
            lambda draw, content: content.replace(b" 4 2 ", pick(draw, OTHER_ELEMENTS)),
            lambda draw, content: content.replace(content.split(b"\n")[1], pick(draw, MSH_HEADS), 1),
        ),
    )


@kind("vtu", 2.5, 8)
def vtu(draw: Draw) -> Attempt:
    """VTK's meshes: text, base64, raw; entities that grow, compressed bombs."""
    return _imported(draw, sound.vtu(), (".vtu",), (_document, _encoding, _bomb, _claims))


def _document(draw: Draw, content: bytes) -> bytes:
    """A document type: entities that grow without end, or that are files."""
    start = f"<!DOCTYPE x [{pick(draw, ENTITIES)}]>".encode()
    words = content.replace(b"Points", b"&l9;&x;", 1)
    whole = b'<?xml version="1.0"?>' + start + words
    return pick(draw, (whole, start + words, content + start, words.replace(b"?>", b"?>" + start, 1)))


def _encoding(draw: Draw, content: bytes) -> bytes:
    """The same letters in an encoding that hides them."""
    name = pick(draw, ENCODINGS)
    text = f"<!DOCTYPE x [{LAUGHS}]>" + content.decode("latin-1")
    return f'<?xml version="1.0" encoding="{name}"?>'.encode() * below(draw, 2) + text.encode(name, "replace")


def _bomb(draw: Draw, content: bytes) -> bytes:
    """Compressed zeros in the place of an array."""
    packed = zlib.compress(b"\0" * pick(draw, (100_000, 10_000_000, BOMB)))
    head = b"".join(n.to_bytes(4, "little") for n in (1, pick(draw, (32768, BOMB, 2**32 - 1)), 0, len(packed)))
    at = content.find(b">", content.find(b"<DataArray")) + 1
    return content[:at] + base64.b64encode(head) + base64.b64encode(packed) + content[content.find(b"<", at) :]


def _claims(draw: Draw, content: bytes) -> bytes:
    """More points and cells than there are."""
    points, cells = b'NumberOfPoints="', b'NumberOfCells="'
    content = content.replace(points, points + pick(draw, (b"9", b"-", b"1e9", b"99999999999")))
    return content.replace(cells, cells + pick(draw, (b"", b"9", b"-1")))


@kind("surfaces", 4, 12)
def surfaces(draw: Draw) -> Attempt:
    """OBJ, STL and PLY: torn, corners that are none, faces that are open or cross; joints over gaps of any width."""
    words = pick(draw, ((), (), ("--gap", "1 cm"), ("--gap", "10 m"), ("--holes", "1 km"), ("--up", "x")))
    return _imported(draw, sound.surfaces(), (".obj", ".stl", ".ply"), (_corner_lost,), words)


@kind("compas", 4, 12)
def compas(draw: Draw) -> Attempt:
    """JSON of COMPAS: torn, numbers that are none, tables in the place of others."""
    return _imported(draw, sound.compas(), (".json",), (_another_table,))


def _another_table(draw: Draw, content: bytes) -> bytes:
    """A key with another value, or under another name."""
    key = pick(draw, (b"data", b"dtype", b"vertex", b"face", b"elements", b"tree", b"root", b"children", b"matrix"))
    value = pick(draw, (b"null", b"5", b'"x"', b"[]", b"{}", b"[null]", b"1e400", b"NaN", b"[" * 200 + b"]" * 200))
    return content.replace(b'"%s": ' % key, pick(draw, (b'"%s": %s, "other": ' % (key, value), b'"xyz": ')), 1)


def _corner_lost(draw: Draw, content: bytes) -> bytes:
    """A line with a number fewer, twice, or elsewhere."""
    lines = content.split(b"\n")
    n = below(draw, len(lines))
    lines[n] = pick(draw, (lines[n].rsplit(b" ", 1)[0], lines[n] + b"\n" + lines[n], lines[n - 1], b"v nan 1e999 -0"))
    return b"\n".join(lines)


@kind("tess", 4, 10)
def tess(draw: Draw) -> Attempt:
    """Neper's tessellations: torn, counts that lie, corners that are none, numbers that are none."""
    words = ("--thickness", "5 cm") if chance(draw, 50) else ()
    return _imported(draw, sound.tess(), (".tess",), (_sections, _flat), words)


def _sections(draw: Draw, content: bytes) -> bytes:
    """Sections in another order, twice, or missing."""
    head, *parts = content.split(b"\n **")
    for _ in range(1 + below(draw, 3)):
        n, m = below(draw, len(parts)), below(draw, len(parts))
        parts[n] = pick(draw, (parts[m], parts[n] + b"\n **" + parts[m], b"", parts[n].split(b"\n")[0]))
    return b"\n **".join([head, *parts]) + pick(draw, (b"", b"\n***end\n"))


def _flat(draw: Draw, content: bytes) -> bytes:
    """Corners on each other, on a line, or bent far off their faces."""
    place = pick(draw, (b"0.05", b"0.2", b"0.07"))
    return content.replace(place, pick(draw, (b"0.0", b"0.2", b"1e7", b"-0.05", b"nan")))


@kind("blocks", 5)
def blocks(draw: Draw) -> Attempt:
    """Files of blocks: other arrays, links, packed and virtual data, damaged bytes."""
    content = (changed_hdf5 if chance(draw, 60) else changed_bytes)(draw, pick(draw, sound.blocks()))
    return Attempt(["check", "a.toml"], {"a.blocks.h5": content, "a.toml": _scene().encode()})


@cache
def _scene() -> str:
    return scene_text(sound.small(), find_joints(sound.small().blocks), Written("blocks", "a.blocks.h5", "--section"))
