"""A scene that is wrong gives one message: file, line and key, what is wrong, and the nearest valid choice."""

import re
import time
from importlib.resources import files

import pytest

from masonry.errors import SceneError
from masonry.scene import load, packaged

COUPLET = files("masonry").joinpath("scenes/couplet.toml").read_text(encoding="utf-8")


def refusal(tmp_path, text, overrides=()):
    file = tmp_path / "bad.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SceneError) as error:
        load(file, overrides)
    return str(error.value).replace(str(file), "bad.toml")


def line_of(text, start):
    return next(n for n, line in enumerate(text.splitlines(), start=1) if line.startswith(start))


PACE = 'accuracy = "1 %"'
NORMAL = 'normal_stiffness = "150 GPa/m"'
BAD = {
    # case: (text to replace, its replacement, the line that is told starts with, dotted key, words of the message)
    "an unknown key": ('width = "50 mm"', 'width = "50 mm"\nzzz = 1', "zzz", "specimen.zzz", ["unknown key", "length"]),
    "a misspelt key": ("width = ", "widht = ", "widht", "specimen.widht", ["did you mean 'width'"]),
    "a misspelt table": ("[contact.unit_unit]", "[contacts.unit_unit]", "[contacts", "contacts", ["'contact'"]),
    "a misspelt top-level key": ("kinematics =", "kinematic =", "kinematic", "kinematic", ["'kinematics'"]),
    "a wrong unit": (NORMAL, NORMAL.replace("/m", ""), "normal", "contact.unit_unit.normal_stiffness", ["GPa/m'"]),
    "a bare number": (NORMAL, "normal_stiffness = 1e9", "normal", "contact.unit_unit.normal_stiffness", ["no unit"]),
    "a negative stiffness": (
        NORMAL,
        NORMAL.replace("150", "-150"),
        "normal",
        "contact.unit_unit.normal_stiffness",
        ["in [1e-6, 1e22]"],
    ),
    "a missing stiffness": (NORMAL, "", "[contact.unit_unit]", "contact.unit_unit.normal_stiffness", ["'150 GPa/m'"]),
    "both spellings of friction": (
        "tan_friction_angle = 1.01",
        'tan_friction_angle = 1.01\nfriction_angle = "45 deg"',
        "tan_friction",
        "contact.unit_unit.tan_friction_angle",
        ["two spellings"],
    ),
    "no friction": (
        "tan_friction_angle = 1.01",
        "",
        "[contact.unit_unit]",
        "contact.unit_unit.friction_angle",
        ["tan_friction_angle"],
    ),
    "NaN": ("_angle = 1.01", "_angle = nan", "tan_friction", "contact.unit_unit.tan_friction_angle", ["finite"]),
    "Poisson's ratio of a liquid": ("= 0.2", "= 0.5", "poisson", "material.units.poisson_ratio", ["[0, 0.5)"]),
    "no density": ('density = "1900', 'density = "0', "density", "material.units.density", ["in [1e-9, 1e15]"]),
    "a joint without shear stiffness": (
        '"70 GPa/m"',
        '"0 GPa/m"',
        "shear_stiffness",
        "contact.unit_unit.shear_stiffness",
        ["law elastic only"],
    ),
    "an unknown law": ('"exponential" ', '"exponental" ', "law", "law", ["did you mean 'exponential'"]),
    "an unknown kinematics": ('"rigid" ', '"rgid" ', "kinematics", "kinematics", ["did you mean 'rigid'"]),
    "an unknown specimen": ('"couplet"', '"cuplet"', "kind", "specimen.kind", ["did you mean 'couplet'"]),
    "a specimen without a kind": (
        'kind = "couplet"',
        "",
        "[specimen]",
        "specimen.kind",
        ["couplet, prism, wallette, bending, arch, bridge, vault"],
    ),
    "rate and steps": (PACE, 'steps = 4\nrate = "1 mm/s"', "steps", "drive.steps", ["exclude each other"]),
    "accuracy and steps": (PACE, 'steps = 4\naccuracy = "1 %"', "steps", "drive.steps", ["exclude"]),
    "an accuracy of half": (PACE, 'accuracy = "50 %"', "accuracy", "drive.accuracy", ["0.01"]),
    "half a step": (PACE, "steps = 0.5", "steps", "drive.steps", ["whole number"]),
    "a huge exponent": ('width = "50 mm"', 'width = "1e999 mm"', "width", "specimen.width", ["finite"]),
    "a tower of powers": ('width = "50 mm"', 'width = "9**9**9 mm"', "width", "specimen.width", ["not a number"]),
    "an unknown dof": ('fix = "all"', 'fix = ["x", "rotations"]', "fix", "support.0.fix.1", ["'rotation'"]),
    "a support that fixes nothing": ('fix = "all"', "fix = []", "fix", "support.0.fix", ["1 or more"]),
    "an unknown direction": ('direction = "x"', 'direction = "u"', "direction", "drive.direction", ["-x, -y, -z"]),
    "a stress along no axis": ("{z = ", "{w = ", "stress", "traction.0.stress.w", ["allowed: x, y, z"]),
    "a stress that is a length": ('"-confinement"', '"5 m"', "stress", "traction.0.stress.z", ["m is a length"]),
    "a stress without direction": ('{z = "-confinement"}', '"1 Pa"', "stress", "traction.0.stress", ["x, y, z"]),
    "a negative confinement": ('= "0.5 MPa"', '= "-0.5 MPa"', "confinement", "confinement", ["in [0, 1e15]"]),
    "an exponent by length": (
        '"0.1 MPa" =',
        '"1 m" =',
        "exponent_shear",
        "contact.unit_unit.exponent_shear",
        ["stress"],
    ),
    "two exponents at one stress": (
        '"0.1 MPa" =',
        '"1000 kPa" =',
        "exponent_shear",
        "contact.unit_unit.exponent_shear",
        ["its own confinement"],
    ),
    "an assumption about nothing": (
        '"support.1.fix" =',
        '"support.2.fix" =',
        "[assumptions]",
        "assumptions",
        ["'support.2.fix' is no key", "did you mean 'support.1.fix'"],
    ),
    "too few divisions": ('height = "50 mm"', "height = '1 m'\ndivisions = [1, 1]", "div", "specimen.divisions.2", []),
    "a billion divisions": (
        'height = "50 mm"',
        "height = '1 m'\ndivisions = [1, 1, 1_000_000_000]",
        "div",
        "specimen.divisions.2",
        ["[1, 1000]"],
    ),
    "a title that is a number": ("title = ", "title = 5 # ", "title", "title", ["text in quotes"]),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_scene_is_told_with_line_key_and_what_would_do(case, tmp_path):
    old, new, start, key, words = BAD[case]
    text = COUPLET.replace(old, new, 1)
    assert text != COUPLET
    message = refusal(tmp_path, text)
    assert message.startswith(f"bad.toml, line {line_of(text, start)}: {key}: ")
    assert "\n" not in message
    for word in words:
        assert word in message


def test_settling_without_dead_loads_is_refused(tmp_path):
    traction = COUPLET[COUPLET.index("[[traction]]") : COUPLET.index("[settle]")]
    assert "leave this table out" in refusal(tmp_path, COUPLET.replace(traction, ""))


def test_a_scene_in_which_nothing_happens_is_refused(tmp_path):
    start = COUPLET.index("[drive]")
    assert "nothing happens" in refusal(tmp_path, COUPLET[:start])


@pytest.mark.parametrize("table", ["specimen", "material", "contact"])
def test_a_missing_table_is_named(table, tmp_path):
    text = re.sub(rf"(?ms)^\[{table}\b.*?(?=^\[(?!{table}\b))", "", COUPLET)
    text = text[: text.index("[assumptions]")]
    assert refusal(tmp_path, text).startswith(f"bad.toml: {table}: missing; give a table [{table}")


def test_a_contact_without_any_law_says_where_to_name_one(tmp_path):
    message = refusal(tmp_path, COUPLET.replace("law = ", "# law = ", 1).split("[contact.within_units]")[0])
    assert "contact.unit_unit.law: missing; name the law here or once at the top" in message


def test_the_word_confinement_needs_the_value(tmp_path):
    message = refusal(tmp_path, COUPLET.replace("confinement = ", "# confinement = ", 1))
    assert "traction.0.stress.z: '-confinement' needs the top-level key confinement" in message


@pytest.mark.parametrize(
    ("kinematics", "lost", "key"),
    [
        ("tets", 'mesh_size = "25 mm"', "specimen.mesh_size"),
        ("tets", "poisson_ratio = 0.2", "material.units.poisson_ratio"),
        ("affine", 'young_modulus = "16.7 GPa"', "material.units.young_modulus"),
    ],
)
def test_deformable_blocks_need_their_constants(kinematics, lost, key, tmp_path):
    text = COUPLET.replace(lost, "")
    assert f"{key}: missing; kinematics '{kinematics}' of units needs it" in refusal(
        tmp_path, text, [f"kinematics={kinematics}"]
    )


def test_many_mistakes_make_one_message_of_six_lines(tmp_path):
    message = refusal(tmp_path, COUPLET.replace("GPa", "Gpa").replace(' mm"', ' mn"'))
    assert len(message.splitlines()) == 6
    assert message.splitlines()[-1] == "... and 5 more"


def test_a_quantity_without_quotes_is_told_line_column_and_quotes(tmp_path):
    text = COUPLET.replace('width = "50 mm"', "width = 50 mm")
    message = refusal(tmp_path, text)
    assert message.startswith("bad.toml: not valid TOML")
    assert f"at line {line_of(text, 'width')}, column" in message
    assert "a quantity stands in quotes: '50 mm'" in message


@pytest.mark.parametrize(
    "text", ["[specimen", "a = [" * 5000, "n = " + "1" * 5000, "[a]\n[a]", 'title = "open', "\x00", "a.b = 1\na = 2"]
)
def test_any_broken_toml_is_one_message(text, tmp_path):
    message = refusal(tmp_path, text)
    assert message.startswith("bad.toml: not ")
    assert len(message) < 400


def test_files_that_are_no_scenes_are_refused_each_in_its_own_words(tmp_path):
    (tmp_path / "latin.toml").write_bytes(b"title = 'a'\nlaw = '\xe9'")
    (tmp_path / "large.toml").write_bytes(b"# " + b"x" * 20_000_001)
    for path, words in (
        (tmp_path / "latin.toml", "line 2: not UTF-8"),
        (tmp_path / "large.toml", "larger than 20 MB"),
        (tmp_path / "none.toml", "no such file"),
        (tmp_path, "is a folder"),
        ("x" * 5000, "cannot be read"),
    ):
        with pytest.raises(SceneError, match=words):
            load(path)


@pytest.mark.parametrize("name", ["cuplet", "couplet.tml", "nowhere/couplet.toml"])
def test_an_unknown_name_is_told_the_nearest_packaged_scene_and_all_of_them(name):
    with pytest.raises(SceneError, match="did you mean 'couplet'") as error:
        load(name)
    for known in packaged():
        assert known in str(error.value)


def test_a_file_of_unknown_keys_is_refused_in_a_time_in_proportion_to_their_number(tmp_path):
    seconds = []
    for count in (10_000, 100_000):
        text = "".join(f"k{n} = {n}\n" for n in range(count)) + COUPLET
        started = time.process_time()
        assert refusal(tmp_path, text).endswith(f"... and {count - 5} more")
        seconds.append(time.process_time() - started)
    assert seconds[1] < 30 * seconds[0]


def test_the_line_is_found_inside_arrays_of_tables_and_after_long_texts(tmp_path):
    text = COUPLET.replace('fix = ["y", "rotation"]', 'fix = ["q"]').replace(
        'title = "Couplet under confinement and shear"', 'title = """\n[drive]\nsteps = 3\n"""'
    )
    line = line_of(text, 'fix = ["q"]')
    assert refusal(tmp_path, text).startswith(f"bad.toml, line {line}: support.1.fix.0: ")


@pytest.mark.parametrize(
    "text", [f"{'.'.join(['a'] * 20000)} = 1", f"[{'.'.join(['a'] * 3000)}]", f"a = {'[' * 90}{']' * 90}"]
)
def test_tables_within_tables_without_end_are_refused_at_once(text, tmp_path):
    begun = time.process_time()
    refusal(tmp_path, 'base = "couplet"\ndrvie = 1\n')
    usual, begun = time.process_time() - begun, time.process_time()
    assert refusal(tmp_path, f'base = "couplet"\n{text}\n').endswith("tables nested too deeply")
    assert time.process_time() - begun < 10 * usual


def test_a_list_is_not_called_empty_because_of_a_wrong_item(tmp_path):
    said = refusal(tmp_path, 'base = "couplet"\nspecimen.cells = {total = 2, sizes = ["a"]}\n')
    assert "sizes.0: 'a' is not a plain number" in said and "\n" not in said


@pytest.mark.parametrize("specimen", ["", 'specimen = "couplet"\n'])
def test_a_key_at_the_wrong_place_is_told_where_there_is_no_table_of_the_specimen(specimen, tmp_path):
    text = refusal(tmp_path, 'length = "1 m"\n' + specimen)
    assert "length" in text and "specimen" in text
