"""What a wheel holds, as its build lists it: all that runs without the clone, under names that every system has."""

import re
import subprocess
from pathlib import Path

import pytest
from setuptools import Distribution

import masonry
from geometry.operating_system import Plain

HOUSE = Path(__file__).resolve().parents[2]
PACKAGES = ("geometry", "masonry", "verification")


@pytest.fixture(scope="module")
def build() -> Distribution:
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(HOUSE)
        distribution = Distribution({"script_name": "pyproject.toml"})
        distribution.parse_config_files()
        distribution.set_defaults()
        build_py = distribution.get_command_obj("build_py")
        build_py.ensure_finalized()
        modules = {Path(path).as_posix() for _, _, path in build_py.find_all_modules()}
        data = {(Path(place) / name).as_posix() for _, place, _, names in build_py.data_files for name in names}
        distribution.listed = modules | data
    return distribution


def test_a_wheel_holds_every_scene_with_its_data_and_every_module_but_those_of_the_paper(build):
    there = {path.relative_to(HOUSE).as_posix() for package in PACKAGES for path in (HOUSE / package).rglob("*")}
    due = {path for path in there if (HOUSE / path).is_file() and not re.search(r"\.py[co]$|__pycache__", path)}
    paper = {path for path in due if path.startswith("verification/paper/")}
    assert build.listed == due - paper
    assert len([path for path in build.listed if re.fullmatch(r"masonry/scenes/[\w-]+\.toml", path)]) == len(
        masonry.scenes()
    )
    assert {
        "masonry/scenes/data/wall.obj",
        "masonry/scenes/data/stones/stone_38.ply",
        "masonry/py.typed",
    } < build.listed
    assert {"verification/report/template.html", "verification/self_test.py"} < build.listed


def test_the_version_stands_in_one_place_and_others_follow(build):
    version = build.get_version()
    cited = re.search(r"^version: (\S+)$", (HOUSE / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    told = re.findall(r"^## \[([\d.]+)\]", (HOUSE / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert version == masonry.__version__ == cited[1] == told[0]


def test_licences_of_the_program_and_of_its_data_go_with_it(build):
    assert build.metadata.license_expression == "GPL-2.0-or-later"
    assert build.metadata.license_files == [
        "LICENSE",
        "masonry/scenes/data/LICENCES.md",
        "masonry/viewing/assets/three-LICENSE",
    ]
    assert all((HOUSE / name).is_file() for name in build.metadata.license_files)


def test_every_file_of_the_tree_has_a_name_that_every_system_has():
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=HOUSE, capture_output=True, check=True).stdout.decode()
    paths = listed.rstrip("\0").split("\0")
    assert len(paths) > 1500 and [path for path in paths if not Plain().is_name(path)] == []
    assert len({path.lower() for path in paths}) == len(paths), "two names are one where case is not told apart"
    assert max(map(len, paths)) < 120, "Windows allows 260 letters, with the folder of the clone"
