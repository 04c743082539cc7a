"""The page on trust has each doubt that there is, with its limit, and none that there is not."""

import re
from pathlib import Path

import pytest

from masonry.judgement import doubts
from masonry.judgement.catalogue import criteria, modules_of
from masonry.judgement.doubt import Criterion
from masonry.laboratory.remarks import edge_reach, hinges, runs, scenes

PAGE = (Path(__file__).parents[2] / "docs" / "trust.md").read_text(encoding="utf-8")
ROWS = [
    line.split(" | ") for line in PAGE.splitlines() if re.match(r"\| `[a-z_0-9]+`", line) and line.count(" | ") == 3
]
LIMITS = {name: row[2] for row in ROWS for name in re.findall(r"`([a-z_0-9]+)`", row[0])}
"""By the name of a doubt."""
FILES = [*modules_of(scenes), *modules_of(runs), hinges, edge_reach]
OF_BLOCKS = {name: file for file in FILES for name in re.findall(r'Doubt\(\s*"(\w+)"', Path(file.__file__).read_text())}
"""The file of each doubt from blocks and joints."""


def test_the_page_has_all_doubts_and_no_others():
    assert LIMITS.keys() == {criterion.name for criterion in criteria()} | OF_BLOCKS.keys()


@pytest.mark.parametrize("criterion", criteria(), ids=lambda criterion: criterion.name)
def test_a_limit_that_is_a_number_stands_beside_its_name(criterion: Criterion):
    if not callable(criterion.limit):
        assert (f"{criterion.limit:g}" if criterion.limit else "-") in LIMITS[criterion.name]


@pytest.mark.parametrize("name", [name for name, file in OF_BLOCKS.items() if hasattr(file, "LIMIT")])
def test_so_do_limits_of_blocks_and_joints(name):
    assert f"{OF_BLOCKS[name].LIMIT:g}" in LIMITS[name]


@pytest.mark.parametrize(
    "file", [*modules_of(doubts), *modules_of(scenes), *modules_of(runs)], ids=lambda f: f.__name__
)
def test_the_head_of_a_file_is_a_question(file):
    assert "?" in (file.__doc__ or "") or not vars(file).keys() & {"doubts", "Criterion"}
