"""In large displacement any two blocks may meet: which table serves them, a floor among them."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables

BOXES = [
    box("low", (0, 0, 0), (0.2, 0.1, 0.05), "units", 0),
    box("top", (0, 0, 0.05), (0.2, 0.1, 0.05), "units", 1, (2, 1, 1)),
    box("far", (1, 0, 0), (0.2, 0.1, 0.05), "stones", 2),
]
DASHPOT = ELASTIC.replace("200", "20") + "\nnormal_dashpot = 0.3"


def scene(contacts, large=True, floor="[floor]\n", more=""):
    materials = {"units": MATERIAL, "stones": MATERIAL}
    return load(
        ('displacements = "large"\n' if large else "")
        + specimen(BOXES, 0.02)
        + tables("material", materials)
        + tables("contact", contacts)
        + listed("support", ['on = "low"\nfix = "all"', *more])
        + '[gravity]\nz = "-9.81 m/s^2"\n'
        + floor
    )


def test_each_pair_of_groups_has_its_own_table_or_the_default():
    built = assemble(scene({"unit_unit": ELASTIC, "default": DASHPOT}))
    pairs, groups = built.pairs, built.specimen.blocks.groups
    assert groups == ("units", "stones", "floor")
    assert pairs.names == ("floor_stones", "floor_units", "stones_units", "unit_unit", "within_units")
    number = {name: k for k, name in enumerate(pairs.names)} | {"": -1}
    wanted = [
        [("unit_unit", "within_units"), ("stones_units", ""), ("floor_units", "")],
        [("stones_units", ""), ("", ""), ("floor_stones", "")],
        [("floor_units", ""), ("floor_stones", ""), ("", "")],
    ]
    assert pairs.number.tolist() == [[[number[name] for name in pair] for pair in row] for row in wanted]
    stiffness = {name: law[1].normal_stiffness for name, law in pairs.laws.items()}
    assert stiffness == {name: 200e9 if name == "unit_unit" else 20e9 for name in pairs.names}
    dashpots = {name: given.normal_dashpot for name, given in pairs.properties.items()}
    assert dashpots == {name: None if name == "unit_unit" else 0.3 for name in pairs.names}


def test_pairs_without_a_table_are_named_all_at_once():
    with pytest.raises(SceneError) as told:
        assemble(scene({"unit_unit": ELASTIC, "within_units": ELASTIC, "floor_units": ELASTIC}))
    assert "[contact.floor_stones], [contact.stones_units], or [contact.default]" in str(told.value)


def test_a_specimen_in_small_displacement_needs_no_pairs():
    tables_needed = {"unit_unit": ELASTIC, "within_units": ELASTIC, "floor_units": ELASTIC, "floor_stones": ELASTIC}
    assert assemble(scene(tables_needed, large=False)).pairs is None


def test_the_floor_is_held_by_itself_and_weighs_nothing_on_the_rest():
    tables_needed = {"unit_unit": ELASTIC, "within_units": ELASTIC, "floor_units": ELASTIC, "floor_stones": ELASTIC}
    built = assemble(scene(tables_needed, large=False))
    floor = built.specimen.sets["floor"]
    assert [one.name for one in built.recording.surroundings.holds] == ["support.0", "floor"]
    held = np.flatnonzero(built.model.bodies.rigid.dt_over_mass[:, 0] == 0.0)
    assert floor[0] in held and len(held) == 2


def test_what_falls_needs_no_support():
    assert assemble(scene({"default": ELASTIC}, floor="")).plan.steps > 0
    with pytest.raises(SceneError, match="held by nothing"):
        assemble(scene({"unit_unit": ELASTIC, "within_units": ELASTIC}, large=False, floor=""))
