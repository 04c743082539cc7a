"""Loads of a limit analysis, and the words of `masonry limit`."""

from tests.fuzz.attempt import Attempt, kind
from tests.fuzz.odd import NUMBERS, QUANTITIES, TEXTS, Draw, below, chance, pick, toml

SCENES = ("arch", "arch-spread", "couplet", "triplet-dry", "wall-tilted", "block-rocking")
VALUES = {
    "pattern": ("weight", "tilt", "force", "traction", "drive", "wind"),
    "direction": ("x", "-x", "y", "z", "-z"),
    "about": ("x", "y", "-y", "z"),
    "on": ("keystone", "top", "bottom", "top.z+", "keystone.y-", "z = 0 mm", "nothing"),
    "force": ({"x": "1 kN"}, {"z": "-1 N", "y": "1e12 N"}, {"z": "0 N"}, {}, "1 kN"),
    "at": (["0 m", "0 m", "1 m"], [0, 0, 0], ["1e5 m", "0 m", "0 m"], ["1 m"]),
    "stress": ({"x": "1 kPa"}, {"z": "-1e15 Pa"}, {"w": "1 Pa"}),
}
OPTIONS = (
    *(["--no-dilation"], ["--no-strength"], ["--safety"], ["--safety", "--at", "0.1"], ["--points", "scene"]),
    *(["--linear", "4"], ["--crushing", "1 MPa"], ["--crushing", "1e-9 Pa"], ["--at", "1e8", "--safety"], ["--view"]),
    *(["--linear", "-1"], ["--crushing", "-1 Pa"], ["--at", "inf"], ["--points", "none"], ["--out"]),
)


@kind("limit", 6)
def limit(draw: Draw) -> Attempt:
    """A packaged scene with some keys of a table [limit], few of them odd, and options that may not fit."""
    keys = [key for key in VALUES if chance(draw, 90 if key == "pattern" else 40)]
    odd = (*TEXTS, *QUANTITIES, *NUMBERS)
    table = {key: pick(draw, odd if chance(draw, 10) else VALUES[key]) for key in keys}
    tree = {"base": pick(draw, SCENES), **({"limit": table} if table or chance(draw, 50) else {})}
    words = [word for _ in range(below(draw, 3)) for word in pick(draw, OPTIONS)]
    return Attempt(["limit", "a.toml", "--json", *words], {"a.toml": toml(tree).encode("utf-8", "surrogatepass")})
