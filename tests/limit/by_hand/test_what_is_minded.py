"""Options and keys that a limit analysis names, under `mind` or as it refuses, are taken as it names them."""

import json
import re

import pytest

import masonry
from masonry.cli.main import main
from masonry.laboratory import laboratory
from masonry.scene import load as packaged
from tests.limit.one_block import STRONG, block
from tests.scenes import load

SIDEWAYS = '[limit]\npattern = "weight"\ndirection = "x"\n'
DRY = {"law": "friction", "normal_stiffness": "30 GPa/m", "shear_stiffness": "12 GPa/m", "tan_friction_angle": 0.7}


def factor(capsys, *words: str) -> dict:
    """What `masonry limit` prints as JSON."""
    assert main(["limit", *words, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


OPTIONS = {"--no-dilation": {"dilation": False}, "--no-strength": {"strength": False}}
OPTIONS |= {"--crushing": {"crushing": "5 MPa"}}
TIED = {"bar": [{"ends": [["1 m", "0.15 m", "0.1 m"], ["1 m", "0.15 m", "-0.5 m"]], "area": "1 cm^2",
                 "young_modulus": "20 GPa", "strength": "10 MPa"}]}  # fmt: skip
FLAT = block("", size='["2 m", "0.3 m", "0.2 m"]')
CRUSHES = 'compressive_strength = "5 MPa"\ncrushing = "cut-off"\n'
MINDED = {
    "a tilt that slides": (FLAT + '[limit]\npattern = "tilt"\nabout = "y"\n', {}, "--no-dilation tells"),
    "a tilt that slides, with bars": (FLAT + '[limit]\npattern = "tilt"\nabout = "y"\n', TIED, "--no-dilation tells"),
    "pyramids": (FLAT + SIDEWAYS, {"sides": 8}, "--no-dilation, without --linear, tells"),
    "safety": (FLAT + SIDEWAYS, {"safety": True, "at": 0.3}, "--no-dilation tells"),
    "strength": (block(SIDEWAYS, STRONG), {}, "--no-strength leaves them out"),
    "crushing": (block(SIDEWAYS, 'law = "friction"\n' + CRUSHES), {}, '--crushing "5 MPa" takes'),
    "crushing with strength": (block(SIDEWAYS, STRONG + CRUSHES), {}, '--crushing "5 MPa" with --no-strength takes'),
    "crushing without strength": (block(SIDEWAYS, STRONG + CRUSHES), {"strength": False}, '--crushing "5 MPa" takes'),
    "crushing by pyramids": (
        block(SIDEWAYS, 'law = "friction"\n' + CRUSHES), {"sides": 8}, '--crushing "5 MPa", without --linear takes',
    ),
    "crushing by other points": (
        block(SIDEWAYS, STRONG + CRUSHES), {"points": "scene"},
        '--crushing "5 MPa" with --no-strength, without --points',
    ),
}  # fmt: skip
"""Scenes, words of a limit analysis or tables besides, and what it says under `mind`."""


@pytest.mark.parametrize("name", MINDED)
def test_options_that_a_limit_analysis_names_are_taken_as_it_names_them(name):
    text, more, said = MINDED[name]
    scene, words = load(text), more
    if "bar" in more:
        scene, words = scene.with_(more), {}
    (line,) = [line for line in masonry.limit(scene, **words).remarks if said in line]
    options = {
        "--no-dilation": {"dilation": False},
        "--no-strength": {"strength": False},
        "--crushing": {"crushing": "5 MPa"},
    }
    kept = {key: value for key, value in words.items() if key not in ("sides", "points") or "without" not in line}
    wanted = re.findall(r"--no-dilation|--no-strength|--crushing", said)
    result = masonry.limit(scene, **kept, **{key: value for one in wanted for key, value in options[one].items()})
    assert result.factor > 0.0 and not any(said in remark for remark in result.remarks)


def test_elastic_joints_are_not_sent_to_an_option_that_leaves_them_as_they_are():
    glued = block(SIDEWAYS, 'law = "elastic"').replace("tan_friction_angle = 0.7\n", "")
    top = '  {name = "top", origin = ["0 m", "0 m", "1 m"], size = ["0.4 m", "0.3 m", "0.2 m"], unit = 2, '
    top += 'group = "tops"},\n]'
    scene = load(glued.replace("]\n[material", top + "\n[material", 1)).with_({
        "contact.tops_units": DRY, "material.tops.density": "2000 kg/m^3"})  # fmt: skip
    remarks = masonry.limit(scene).remarks
    assert any(line.startswith("joints of unit_unit are elastic: they bear any force") for line in remarks)
    assert not any("--no-strength" in line for line in remarks)


def test_where_a_travelling_vehicle_stands_worst_a_run_takes_it_as_it_is_told():
    lines = " ".join(str(masonry.limit("bridge-single-span")).split())
    keys = dict(re.findall(r"--set '?([\w.]+)=([\w. ]+?)'?(?= --set| which is)", lines.split("a run there: ")[1]))
    assert keys.keys() == {"vehicle.position", "limit.accuracy"}
    assert laboratory.check(packaged("bridge-single-span", keys))["warnings"] == []


REFUSED = {
    "limit: two of a kind": (["--linear", "8", "--no-dilation"], ["--no-dilation"]),
    "limit: points beside crushing": (["--crushing", "5 MPa", "--points", "scene"], ["--crushing", "5 MPa"]),
    "limit: at": (["--at", "0.1"], ["--at", "0.1", "--safety"]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_words_that_were_refused_are_taken_as_the_refusal_says(name, tmp_path, capsys):
    (tmp_path / "one.toml").write_text(block(SIDEWAYS))
    before, after = REFUSED[name]
    assert main(["limit", str(tmp_path / "one.toml"), *before]) == 2
    capsys.readouterr()
    assert factor(capsys, str(tmp_path / "one.toml"), *after)["factor"] > 0.0
