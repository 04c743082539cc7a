"""Data of a contact table: words of the command that do not fit, and files of shear tests that are damaged."""

from pathlib import Path

from tests.fuzz.attempt import Attempt, kind
from tests.fuzz.changes import changed_text, changed_word
from tests.fuzz.odd import NO_FILES, NUMBERS, QUANTITIES, TEXTS, Draw, chance, pick

TESTS = b"# pressure, strength [MPa]\n0.2, 0.41\n0.2, 0.37\n0.6, 0.66\n1.0, 0.95\n"
SOUND = {
    **{"--unit": "clay", "--unit-strength": "20 MPa", "--unit-modulus": "16.7 GPa", "--unit-height": "65 mm"},
    **{"--mortar": "M5", "--joint": "10 mm", "--friction": "31 deg", "--divisions": "2", "--crushing": "cap"},
    **{"--triplets": "tests.csv", "--law": "linear", "--poisson": "0.2", "--contact": "unit_unit"},
}
ODD = (*QUANTITIES, *TEXTS, *map(str, NUMBERS), *NO_FILES)


@kind("contact-tables", 8)
def contact_tables(draw: Draw) -> Attempt:
    """Options of `masonry contact` with odd values, left out or changed, and a file of tests that is damaged."""
    data = dict(SOUND)
    del data["--friction" if chance(draw, 80) else "--triplets"]
    for option in list(data):
        if chance(draw, 10):
            del data[option]
        elif chance(draw, 15):
            data[option] = pick(draw, ODD) if chance(draw, 60) else changed_word(draw, data[option])
    content = changed_text(draw, TESTS) if chance(draw, 60) else TESTS
    tests: bytes | Path = content if chance(draw, 90) else Path("/etc/shadow")
    words = [f"{option}={value}" for option, value in data.items()]
    return Attempt(["contact", *words, "--out", "own.toml"], {"tests.csv": tests}, ("own.toml",))
