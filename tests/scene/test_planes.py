"""Selectors that name a plane in place of a set."""

import numpy as np
import pytest

from masonry.assembly.conditions import select
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.scene import load

SHORT = {"drive.steps": 50, "settle.steps": 20, "solver.rows": 2}


@pytest.fixture(scope="module")
def couplet():
    return laboratory.assemble(load("couplet", SHORT))


@pytest.mark.parametrize(("word", "same"), [("z = 0 mm", "bottom.z-"), ("z=100 mm", "top.z+"), ("x = 0.2 m", None)])
def test_a_plane_selects_its_outer_faces(couplet, word, same):
    blocks, faces = select(couplet.specimen, couplet.joints, word, "support.0.on")
    assert np.array_equal(np.unique(couplet.specimen.blocks.face_block()[faces]), blocks)
    if same is None:
        assert blocks.tolist() == [0, 1]
    else:
        assert np.array_equal(faces, select(couplet.specimen, couplet.joints, same, "support.0.on")[1])


def test_blocks_at_a_plane_are_whole_blocks(couplet):
    blocks, faces = select(couplet.specimen, couplet.joints, "blocks at z = 50 mm", "drive.on")
    assert blocks.tolist() == [0, 1] and faces is None
    assert select(couplet.specimen, couplet.joints, "blocks at z = 0 mm", "drive.on")[0].tolist() == [0]


@pytest.mark.parametrize(
    ("word", "said"),
    [
        ("z = 1 mm", "nearest planes with faces are z = 0 mm, z = 50 mm, z = 100 mm"),
        ("z = 50 mm", "lie in joints"),
        ("z = 50", "50"),
        ("z = 50 kg", "support.0.on"),
        ("blocks at y = 1 m", "nearest planes with faces are y = 0 mm, y = 50 mm"),
    ],
)
def test_a_plane_without_faces_is_refused_with_the_nearest(couplet, word, said):
    with pytest.raises(SceneError) as error:
        select(couplet.specimen, couplet.joints, word, "support.0.on")
    assert said in str(error.value) and "support.0.on" in str(error.value)


def test_a_run_with_planes_is_that_with_sets():
    by_set = laboratory.run(load("couplet", SHORT)).summary
    planes = {"support.0.on": "blocks at z = 0 mm", "drive.on": "blocks at z = 100 mm", "traction.0.on": "z = 100 mm"}
    by_plane = laboratory.run(load("couplet", {**SHORT, **planes})).summary
    for key in ("peak_stress_pa", "final_stress_pa", "energy_imbalance"):
        assert by_plane[key] == by_set[key]
