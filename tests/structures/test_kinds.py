"""The table of each kind of specimen answers for it: what it builds, and how much that is about."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from geometry.polyhedra.measures import volumes
from masonry.assembly.specimens import specimen_of
from masonry.scene import load
from masonry.scene.tables.specimen import TABLES, Specimen, table_of
from masonry.scene.tables.specimens.common import SpecimenTable

STACK = {"length": 0.21, "width": 0.1, "height": 0.052, "divisions": (2, 1, 3)}
BRICKS = {"unit_length": 0.21, "unit_height": 0.052, "thickness": 0.1, "joint_thickness": 0.01}
WALL = {"length": 1.32, "height": 0.62, "unit_length": 0.21, "unit_height": 0.052, "joint_thickness": 0.01}
KINDS = {
    "couplet": {**STACK, "mortar": {"thickness": 0.01, "divisions": (2, 1, 1)}},
    "prism": {**STACK, "units": 5, "plates": 0.02},
    "wallette": {**BRICKS, "courses": 6, "units_per_course": 3.5, "divisions": (2, 1)},
    "bending": {**BRICKS, "courses": 5, "units_per_course": 4, "divisions": (2, 1, 1)},
    "arch": {"radius": 2.0, "angle": 2.4, "thickness": 0.3, "voussoirs": 15, "depth": 0.8},
    "bridge": {
        "depth": 1.1,
        "arch": [
            {"span": 3.0, "rise": 1.0, "thickness": 0.3, "voussoirs": 13},
            {"span": 2.0, "rise": 0.8, "thickness": 0.25, "voussoirs": 11},
        ],
        "pier": [{"width": 0.9, "height": 1.5, "courses": 4}],
    },
    "vault": {"span": 3.0, "rise": 1.2, "thickness": 0.2, "courses": 15, "length": 2.5, "units_per_course": 4},
    "dome": {"radius": 2.0, "thickness": 0.2, "courses": 7, "voussoirs": 16, "crown": 0.4},
    "column": {"diameter": 0.5, "height": 2.4, "drums": 6, "sides": 12},
    "tower": {"width": 1.5, "thickness": 0.3, "courses": 9, "unit_length": 0.6, "unit_height": 0.2},
    "wall": {**WALL, "thickness": 0.1, "returns": "left", "return_length": 0.65},
    "multi-leaf": {**WALL, "leaf_thickness": 0.1, "core_thickness": 0.15, "core": {"total": 40}},
    "boxes": {
        "section": 0.02,
        "box": [
            {"name": "low", "origin": (0.0, 0.0, 0.0), "size": (0.3, 0.2, 0.1), "divisions": (3, 2, 1)},
            {"name": "high", "origin": (0.05, 0.0, 0.1), "size": (0.2, 0.2, 0.2)},
        ],
    },
}
"""A small specimen of each kind, in SI; of blocks from a file their number and volume are known."""


def given(value):
    """Numbers with the unit that a file gives them: metres where they are no counts."""
    if isinstance(value, dict):
        return {key: value[key] if key in ("angle", "section") else given(value[key]) for key in value}
    if isinstance(value, list | tuple):
        return [given(one) for one in value]
    return f"{value} m" if isinstance(value, float) and value != 3.5 else value


@pytest.mark.parametrize("kind", [kind for kind in TABLES if kind != "file"])
def test_a_kind_builds_specimens_of_its_own_shape_and_estimates_their_number_of_blocks_and_their_volume(kind):
    words = {"angle": "2.4 rad", "section": "0.02 m^2"}
    table = {key: words.get(key, given(value)) for key, value in KINDS[kind].items()}
    spec = TypeAdapter(Specimen).validate_python({"kind": kind, **table})
    specimen = spec.build()
    blocks, volume = spec.blocks_and_volume
    group = np.array(specimen.blocks.groups)[specimen.blocks.group]
    laid, units = ~np.isin(group, ["plates", "rollers"]), ~np.isin(group, ["plates", "rollers", "mortar"])
    assert table_of(specimen.shape) is type(spec)
    assert blocks == pytest.approx(laid.sum(), rel=0.2)
    assert volume == pytest.approx(volumes(specimen.blocks)[units].sum(), rel=0.3)


def test_a_shape_of_no_kind_is_seen_as_any_specimen_is():
    assert table_of("statue") is SpecimenTable and not table_of("statue").seen_along_y
    assert table_of(specimen_of(load("couplet")).shape) is TABLES["couplet"]
