"""The reference names every key of the schema and of the results, and no other."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import pytest
from pydantic import BaseModel

from masonry.laboratory import laboratory
from masonry.laws import law_names
from masonry.rows.columns import UNITS
from masonry.scene import Scene, load
from tests.docs.pages import blocks

ROOT = Path(__file__).resolve().parents[2]
SCENE = (ROOT / "docs" / "scene.md").read_text(encoding="utf-8")
RESULTS = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")


def schema_keys(kind: Any) -> Iterator[str]:
    """Every key that a type of the schema has, those of the tables within it included."""
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        for name, field in kind.model_fields.items():
            yield name
            yield from schema_keys(field.annotation)
        yield from schema_keys(getattr(kind, "ANY", None))
    elif hasattr(kind, "_fields"):
        yield from kind._fields
    for part in get_args(kind):
        yield from schema_keys(part)


def in_backticks(text: str) -> list[str]:
    """What stands in backticks outside of code blocks."""
    return re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL))


def words(text: str) -> set[str]:
    """Every word that stands in backticks."""
    return {word for code in in_backticks(text) for word in re.findall(r"[\w-]+", code)}


def first_column(text: str, header: str) -> set[str]:
    """The first cells of the tables whose first column has this header."""
    tables = re.findall(rf"^\| {header} \|.*\n\|[-|]+\n((?:\|.*\n)+)", text, re.MULTILINE)
    return {cell for table in tables for cell in re.findall(r"^\| `([^`]+)` \|", table, re.MULTILINE)}


def all_keys(value: Any) -> set[str]:
    return set(value) | set().union(*(all_keys(below) for below in value.values() if isinstance(below, dict)))


@pytest.fixture(scope="module")
def summary():
    scene = load("couplet", {"drive.steps": 20, "settle.steps": 10, "solver.rows": 2})
    return laboratory.run(scene).summary


@pytest.mark.parametrize("key", sorted(set(schema_keys(Scene))))
def test_the_reference_names_every_key_of_the_schema(key):
    assert key in words(SCENE)


def test_the_walk_through_the_schema_reaches_every_corner():
    assert {"specimen", "mortar", "origin", "exponent_shear", "correlation", "fix", "z", "time_step"} <= set(
        schema_keys(Scene)
    )


def test_the_tables_of_the_reference_name_no_key_that_there_is_not():
    assert first_column(SCENE, "key") <= set(schema_keys(Scene))


def test_the_reference_names_every_law():
    assert first_column(SCENE, "law") == set(law_names())


def test_the_results_name_every_key_of_the_summary_and_no_other(summary):
    assert first_column(RESULTS, "key") == set(summary)
    assert set(summary["energy_j"]) <= set(in_backticks(RESULTS))


def test_the_results_name_every_column_of_the_curve_and_no_other():
    assert first_column(RESULTS, "column") == set(UNITS)


def test_the_reference_has_an_example_of_boxes_and_one_of_a_wallette_with_affine_units():
    examples = [tomllib.loads(block.text) for block in blocks("docs/scene.md") if block.language == "toml"]
    whole = [example for example in examples if "kind" in example.get("specimen", {})]
    assert [example["specimen"]["kind"] for example in whole] == ["boxes", "boxes", "wallette"]
    assert whole[-1]["kinematics"]["default"] == "affine"
