"""Joints answer for themselves, whether they crush, meet by patches and have dashpots, or not."""

from math import inf

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.configuration import configuration_of
from masonry.configuration.energy import columns_of_joints, ledger, observe, velocities
from masonry.patches.arrays import CRUSHED, FRICTION
from masonry.rows.columns import LARGE_UNITS
from masonry.scene import load as load_scene
from tests.faults.test_same_bits import CRUSHES


@pytest.mark.parametrize(
    ("changes", "columns"),
    [
        ({}, ()),
        (CRUSHES, ("crushing",)),
        ({"displacements": "large"}, tuple(LARGE_UNITS)),
        (CRUSHES | {"displacements": "large"}, (*LARGE_UNITS, "crushing")),
    ],
    ids=["small", "crushing", "large", "large, crushing"],
)
def test_the_ledger_has_a_column_for_what_joints_can_take_and_adds_up_contacts_and_patches(changes, columns):
    model = assemble(load_scene("couplet", changes)).model
    configuration, area = configuration_of(model), model.joints.area
    assert columns_of_joints(model) == columns
    model.state.dissipated[:, 2] = 3.0
    booked = {"friction": 3.0 * area.sum(), "crushing": 0.0}
    if model.crushes:
        model.state.crushed[1] = 2e-5, 1e-5, 70.0
        booked["crushing"] = 70.0 * area[1]
        assert configuration.crushing.closing().max() == 2e-5
        assert configuration.crushing.closed(np.full(len(area), -5e-5))[:2] == pytest.approx([5e-5, 3e-5])
        assert configuration.crushing.in_contacts(np.full(len(area), 0.1)) == (pytest.approx(2e-4), 1)
    else:
        assert configuration.crushing.closing() is None
        assert configuration.crushing.closed(np.array([-5e-5])) == 5e-5
    if model.large is None:
        assert configuration.patches.skin == inf and configuration.patches.deepest(area) == (0.0, (0, 0))
    else:
        model.large.near.account[[FRICTION, CRUSHED]] = 0.25, 0.5 * model.crushes
        booked["friction"] += 0.25
        booked["crushing"] += 0.5 * model.crushes
    terms = ledger(model, observe(model), velocities(model))
    assert [column for column in columns if column not in terms] == []
    assert {name: terms.get(name, 0.0) for name in booked} == pytest.approx(booked)
