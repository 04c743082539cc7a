"""What the frames of a run say agrees with the forces and the motion that made them."""

import numpy as np
import pytest

import masonry
from masonry.results.fields import BlockGrid
from masonry.results.joint_fields import JointGrid


@pytest.fixture(scope="module")
def sheared():
    """Three rigid units on each other, pressed by 0.5 MPa, the top one pushed aside; more frames than by default."""
    scene = masonry.load(
        "couplet",
        {
            **{"specimen.kind": "prism", "specimen.units": 3, "solver.frames": 60},
            **{"drive.displacement": "0.05 mm", "drive.accuracy": "5 %", "solver.rotation_limit": 0.1},
        },
    )
    return masonry.run(scene)


def test_the_unit_between_two_joints_carries_the_pressure_and_the_shear_that_the_drive_gives(sheared):
    rows, blocks = sheared.history.rows, sheared.specimen.blocks
    height = blocks.points[blocks.face_points, 2].reshape(3, -1).mean(axis=1)
    middle = int(np.argsort(height)[1])
    driven = [frame for frame in sheared.history.frames if frame.displacement > 1e-6]
    for frame in driven:
        shear = np.interp(frame.step, rows["step"], rows["stress"])
        _, yy, zz, yz, xz, xy = frame.stress[middle]
        assert zz == pytest.approx(-0.5e6, rel=0.02)
        assert xz == pytest.approx(shear, rel=0.03)
        assert max(map(abs, (yy, yz, xy))) < 1e-3, "nothing acts along y"
        assert not np.delete(frame.stress, middle, axis=0).any(), "the others are held or driven"
    assert len(driven) > 10


def test_opening_and_slip_are_what_the_corners_of_the_blocks_did(sheared):
    grid = JointGrid(sheared)
    for frame in sheared.history.frames:
        data = grid.cell_data(frame)
        slip = np.linalg.norm(data["slip_vector"], axis=1)
        np.testing.assert_allclose(slip, frame.slip, rtol=1e-9, atol=1e-15)
    assert frame.slip.max() > 1e-5


def test_a_scene_asks_for_more_frames_and_all_are_in_the_fields(sheared):
    frames = sheared.history.frames
    assert 24 + 2 < len(frames) <= 60 + 2
    assert np.all(np.diff([frame.step for frame in frames]) > 0)
    grid = BlockGrid(sheared)
    assert grid.cell_data(frames[-1])["stress"].shape == (18, 6)
