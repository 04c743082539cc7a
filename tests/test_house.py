"""What is counted in the house stays within its limits: they only ever go down."""

import pytest

import tests.house_counts as counts

LIMITS = {
    "lines of masonry that read .large": 4,
    "files of masonry that compare .large with None": 3,
    "asserts that .large is there": 0,
    "comparisons with a word for a kind of deformation or displacement": 4,
    "isinstance of a plan or a loading": 0,
    "lines of the longest function that is not compiled": 45,
    "branches of the function that branches most": 16,
    "attributes of the loading that has most": 12,
    "class names that stand more than once": 4,
    "file names that stand more than once in masonry": 0,
    "lines with `found`, tests included": 326,
    "lines that name something by a participle alone": 183,
    "lines that name a number by how much it is": 1549,
    "docstrings that begin with What": 69,
    "lines of masonry that ask whether there are bars": 0,
    "lines of masonry that ask whether joints crush": 17,
    "files of masonry that name bars": 17,
    "fields of a model": 31,
    "members of a configuration": 18,
}
SOURCE = counts.Source(counts.ROOT)


@pytest.mark.parametrize("words", counts.COUNTS)
def test_a_count_is_within_its_limit(words: str) -> None:
    assert counts.COUNTS[words](SOURCE) <= LIMITS[words], f"{words}: `python tests/house_counts.py` shows where"


def test_what_is_counted_is_seen() -> None:
    source = counts.Source.__new__(counts.Source)
    path = counts.Path("masonry/model/made_up.py")
    source.text = {
        path: "\n".join(
            [
                "from masonry.model.large import meeting",
                "class Twice: pass",
                "class Twice: pass",
                "class Model:",
                "    bars: Bars",
                "class Configuration(Protocol):",
                "    def columns(self): pass",
                "class MyLoading:",
                "    def __init__(self, plan):",
                "        self.found = 1 if plan.large is None else 2",
                "        assert plan.large is not None",
                "        if isinstance(plan, Path) or kind == 'rigid':",
                "            asks = self.bars is None",
                "            crushes = state.crushed is not None",
                "        self.off = 1.0 - least",
                '        """What is made up."""',
            ]
        )
    }
    source.trees = {path: counts.ast.parse(source.text[path])}
    number = {words: count(source) for words, count in counts.COUNTS.items()}
    assert number == {
        "lines of masonry that read .large": 2,
        "files of masonry that compare .large with None": 1,
        "asserts that .large is there": 1,
        "comparisons with a word for a kind of deformation or displacement": 1,
        "isinstance of a plan or a loading": 1,
        "lines of the longest function that is not compiled": 7,
        "branches of the function that branches most": 3,
        "attributes of the loading that has most": 2,
        "class names that stand more than once": 1,
        "file names that stand more than once in masonry": 0,
        "lines with `found`, tests included": 1,
        "lines that name something by a participle alone": 1,
        "lines that name a number by how much it is": 1,
        "docstrings that begin with What": 1,
        "lines of masonry that ask whether there are bars": 1,
        "lines of masonry that ask whether joints crush": 1,
        "files of masonry that name bars": 1,
        "fields of a model": 1,
        "members of a configuration": 1,
    }
