"""Scenes, what they stand on, and the words of the command line."""

import os
import tomllib
from pathlib import Path

from tests.fuzz import sound
from tests.fuzz.attempt import Attempt, kind
from tests.fuzz.changes import changed_text, changed_tree, changed_word
from tests.fuzz.odd import NO_FILES, NUMBERS, QUANTITIES, TEXTS, Draw, below, chance, pick, toml

HUGE = 5_000_001
PIECES = (
    *(b"a.", b"[", b"[[a]]\n", b"{a=", b"a = 1\n", b'"', b"'''", b"\\", b"#", b"[a.b.c]\n", b"x = [", b"\n", b"0_"),
    *(b"a = 1e", b"1", b"a.a.a.a.a = 1\n", b"\xff", b"a = '\n", b"[specimen]\n"),
)
SOUND = {
    **{"specimen.length": "25.4 mm", "contact.unit_unit.cohesion": "0.87 MPa", "drive.displacement": "1e-4 m"},
    **{"contact.unit_unit.normal_stiffness": "150 GPa/m", "contact.unit_unit.friction_angle": "45 deg"},
    **{
        "material.units.density": "1900 kg/m^3",
        "drive.accuracy": "1 %",
        "confinement": "2 MPa",
        "gravity.z": "-9.81 m/s^2",
    },
}
NUMBERS_WITH_UNITS = (*SOUND.values(), "58 N/m", "130 N/m/MPa", "2 inch*ft", *QUANTITIES, *TEXTS)
HISTORIES = (
    "0.1 mm * sin(2 pi t / 1 s) * ramp(t / 4 s)",
    "0.2 mm * triangle(t / 2 s) - 0.1 mm * sin(pi t / 3 s) * (1 - ramp(t / 1 s))",
    "(((0.1 mm))) * t / 1 s",
    '["0.1 mm", "-0.1 mm", "0 mm"]',
    '[["0 s", "0 mm"], ["1 s", "0.1 mm"], ["2 s", "-0.1 mm"]]',
)
LONG = ("(", "sin(", "1 mm * ", "-", "[", "t * ", "1 mm + ")
SCENES = ("couplet", "wallette-mode-1", "bending-0")
KEYS = (
    *("law", "kinematics", "confinement", "contact.unit_unit.cohesion", "specimen.length", "specimen.cells.total"),
    *("support.0.on", "support.1.fix", "drive.on", "drive.steps", "drive.direction", "traction.0.stress.z", "scatter"),
    *("gauge", "curve.x", "title", "name", "assumptions", "solver.damping", "kinematics.units", "material", "base"),
    *("specimen.kind", "settle.steps", "gravity.z", "contact", "", ".", "a..b", "support.-1.on", "support.x"),
    *('contact."unit_unit".law', "specimen.divisions.0", "specimen", "support", "x" * 2000, "a." * 500),
)
OPTIONS = (
    *("--out", "--set", "--threads", "--overwrite", "--quiet", "--to", "--geometry", "--view", "--unit", "--section"),
    *(
        "--tolerance",
        "--thickness",
        "--facet",
        "--group",
        "--open-gaps",
        "--workers",
        "--compare",
        "--format",
        "--list",
    ),
    *("--scheduler", "--version", "--help", "--no-such", "-x", "--"),
)
CHEAP = ("check", "export", "import", "list", "picture", "plot", "--version", "--help", "", "chekc", "no\nsuch")
ODD_WORDS = (*TEXTS, *QUANTITIES, *map(str, NUMBERS), *NO_FILES)
NAMES = [word for word in ODD_WORDS if not word.startswith(("/", "..", "~"))]
"""Those that ask for nothing outside the working folder."""


@kind("scene", 34, 40)
def scene(draw: Draw) -> Attempt:
    """Every packaged scene with keys, values and text changed; looked at, now and then exported or drawn."""
    text = pick(draw, sound.scenes())
    if chance(draw, 60):
        content = toml(changed_tree(draw, tomllib.loads(text))).encode("utf-8", "surrogatepass")
    else:
        content = changed_text(draw, text.encode())
    files: dict[str, bytes | Path] = {"a.toml": content}
    way = below(draw, 100)
    if way > 95:
        return Attempt(["export", "a.toml", "--to", "out.step"], files, ("out.step",))
    if way > 93:
        return Attempt(["picture", "a.toml", "--geometry", "--out", "out.png"], files, ("out.png",))
    return Attempt(["check", "a.toml"], files)


@kind("scene-files", 10)
def scene_files(draw: Draw) -> Attempt:
    """Scenes on scenes that are no files, torn, huge, or stand on themselves; specimens from files that are none."""
    odd, way = pick(draw, NO_FILES), below(draw, 6)
    if way == 0:
        return Attempt(["check", odd])
    files: dict[str, bytes | Path] = {}
    if way == 1:
        content = toml({"base": odd})
    elif way == 2:
        content = toml({"base": "couplet", "specimen": {"kind": "file", "path": odd}})
    elif way == 3:
        content = toml({"base": "0.toml"})
        for n in range(1 + below(draw, 12)):
            files[f"{n}.toml"] = f'base = "{pick(draw, (n + 1, 0, n))}.toml"\n'.encode()
    elif way == 4:
        return Attempt(["check", "a.toml"], {"a.toml": _large(draw)})
    else:
        files["below.toml"] = changed_text(draw, pick(draw, sound.scenes()).encode())
        content = toml({"base": "below.toml", "law": pick(draw, ("linear", "x", odd))})
    return Attempt(["check", "a.toml"], files | {"a.toml": content.encode("utf-8", "surrogatepass")})


def _large(draw: Draw) -> bytes:
    """What takes a careless reader long, or much memory."""
    piece = pick(draw, PIECES)
    return pick(draw, (b"", b"a = ", b'title = "', b"[support]\n")) + piece * (
        pick(draw, (1000, 30_000, HUGE)) // len(piece) + 1
    )


@kind("quantity", 8)
def quantity(draw: Draw) -> Attempt:
    """Numbers with units, in --set and in options that take one."""
    key = pick(draw, list(SOUND))
    changed = changed_word(draw, SOUND[key] if chance(draw, 40) else pick(draw, NUMBERS_WITH_UNITS))
    if chance(draw, 80):
        return Attempt(["check", "couplet", "--set", f"{key}={changed}"])
    option = pick(draw, ("--unit", "--tolerance", "--thickness", "--facet", "--section"))
    return Attempt(["import", "none.step", "--out", "new.toml", option, changed])


@kind("histories", 5)
def histories(draw: Draw) -> Attempt:
    """Histories of a drive: expressions, turning points and tables, on the couplet that is sheared back and forth."""
    seed = pick(draw, HISTORIES if chance(draw, 80) else (*QUANTITIES, *TEXTS))
    if chance(draw, 10):
        seed = pick(draw, LONG) * pick(draw, (30, 500, 20_000)) + seed
    words = ["check", "couplet-cyclic", "--set", f"drive.history={changed_word(draw, seed)}"]
    if chance(draw, 10 if seed.startswith("[") else 90):
        words += ["--set", f"drive.duration={pick(draw, ('1 s', '4 s', '1e9 s', '0 s', 'nan s'))}"]
    return Attempt(words)


RECORD = b"# a record\n# Time (s), North (g), Up (cm/s2)\n0.0,0.01,1\n0.01,-0.2,2\n0.02,0.3,-1\n0.03,0,0.5\n"
OTHER_RECORDS = (
    b"A town\nUNITS OF G\nNPTS= 7, DT= .0100 SEC\n  .1E-01 -.2D-01 0.3E+00\n -.1E+00-.2E+00 0.1E-01\n 0.0\n*** End\n",
    b"Sampling Freq(Hz) 100Hz\nDuration Time(s)  0.08\nScale Factor      2000(gal)/8388608\nMemo.             \n"
    b"     4321     5301     8237    13113    19907    28584    39101    51406\n",
    b"SAMPLING_INTERVAL_S: 0.01\nNDATA: 4\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\nUSER5:\n1.0\n-2.0\n3.0\n0.5\n",
    b"".join(b" %7.3f %7.3f %7.3f\n" % (0.1 * k, 0.1 * k + 0.03, 0.1 * k + 0.07) for k in range(9)) + b" 0.9\n",
    b"Corrected acceleration (Format v01.20 with 13 text lines)\n 1.0 2.0\n",
)
"""Of other formats: PEER, K-NET, ESM, numbers alone, one that is refused."""
IN_RECORDS = (
    b"NPTS= 4\n",
    b"1" * 400,
    b"nan",
    b"inf",
    b"1e999",
    b";",
    b"\t",
    b",",
    b",,",
    b"\xef\xbb\xbf",
    b"\n\n",
    b"#",
    b"(ms)",
    b"(",
    b"-",
    b"\x00",
)
OF_GROUND = {
    "quantity": ("acceleration", "velocity", "displacement", "force"),
    "unit": ("g", "m/s2", "mm", "cm/s^2", "", "kg"),
    "x": ("North", "up", "2", "9", "0.4 g * sin(2 pi t / 1 s)", ""),
    "scale": (1, -2.5, 0, 1e9, "x"),
    "peak": ("0.4 g", "0 g", "1 mm", "nan g"),
    "baseline": ("linear", "none", 1),
    "begin": ("1 s", "-1 s", 0),
    "as": ("base", "inertia", "frame"),
    "on": ("bottom", "floor", "nothing"),
    "duration": ("1 s", "1e9 s"),
    "time": ("Time", "North", "1"),
}


@kind("ground-records", 6)
def ground_records(draw: Draw) -> Attempt:
    """Records of the ground, changed as text, and the keys that read them."""
    of_table = chance(draw, 50)
    content = changed_text(draw, RECORD if of_table else pick(draw, OTHER_RECORDS))
    for _ in range(below(draw, 3)):
        place = below(draw, len(content) + 1)
        content = content[:place] + pick(draw, IN_RECORDS) + content[place + below(draw, 3) :]
    keys = {key: pick(draw, values) for key, values in OF_GROUND.items() if chance(draw, 15)}
    columns = {"x": "North", "z": "Up"} if of_table else {"x": "1", "unit": "g"}
    ground = {"record": "own.csv", **columns, **keys}
    scene = toml({"base": "block-rocking", "ground": ground, "solver": {"duration": "0.1 s"}})
    return Attempt(["check", "a.toml"], {"a.toml": scene.encode("utf-8", "surrogatepass"), "own.csv": content})


@kind("words", 14)
def words(draw: Draw) -> Attempt:
    """Words that no one should write: settings, folders, options of every command."""
    way = below(draw, 6)
    if way < 3:
        pairs = [f"{pick(draw, KEYS)}={pick(draw, ODD_WORDS)}" for _ in range(1 + below(draw, 3))]
        if chance(draw, 10):
            pairs.append(pick(draw, ODD_WORDS))
        return Attempt(["check", pick(draw, SCENES), *(word for pair in pairs for word in ("--set", pair))])
    if way == 3:
        return Attempt(["run", "couplet", "--set", "drive.on=nothing", pick(draw, OPTIONS), pick(draw, NAMES)])
    if way == 4:
        name = pick(draw, NAMES)
        to = pick(draw, (name, f"{name}.step", f"{name}.png", f"no/{name}.msh"))
        command = pick(draw, (["export", "couplet", "--to"], ["picture", "couplet", "--geometry", "--out"]))
        return Attempt([*command, to], writes=_inside(to))
    more = [pick(draw, CHEAP), *(pick(draw, (*OPTIONS, *NAMES, *SCENES)) for _ in range(below(draw, 5)))]
    return Attempt(more, writes=tuple(place for word in more for place in _inside(word)))


def _inside(word: str) -> tuple[str, ...]:
    """What a word may name in the working folder, and what is drawn without a name."""
    place = os.path.normpath(word)
    return (*(() if place.startswith(("/", "..")) else (place,)), *(f"{name}-geometry.png" for name in SCENES))
