"""What is mended as surfaces are read: corners in the edges of neighbours; bodies far from the origin."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.files.surfaces.reader import read_surfaces
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import volumes
from geometry.polyhedra.validate import require_sound
from tests.geometry.files.surface_files import CUBE, corners, obj

STONE = np.array([*corners(size=(0.4, 0.2, 0.2)), (0.15, 0, 0.2), (0.15, 0.2, 0.2)])
PARTED = [*(face for face in CUBE if set(face) != {5, 6, 7, 8}), (5, 9, 10, 8), (9, 6, 7, 10)]
"""A top of two faces, whose common edge ends in the middle of two edges of the sides."""


def turn(points, seed):
    from scipy.spatial.transform import Rotation

    return Rotation.random(random_state=seed).apply(points)


@pytest.mark.parametrize("seed", range(3))
def test_a_corner_on_the_edge_of_a_neighbour_is_put_into_it(tmp_path, seed):
    for digits in (np.float64, np.float32):
        path = obj(tmp_path / "t.obj", turn(STONE, seed).astype(digits).astype(float), faces=PARTED)
        solids = read_surfaces(path, 1.0, flat=1e-4)
        require_sound(solids.blocks)
        assert volumes(solids.blocks) == pytest.approx([0.016], rel=1e-6)
        assert "put into that edge: 2; the bodies have 0.016 m^3" in solids.notes[0]
        assert len(solids.blocks.face_start) - 1 == 6


def test_a_hint_for_an_open_surface_is_given_only_if_it_closes_it(tmp_path):
    """A lid that is missing can be closed; an edge of three faces cannot."""
    with pytest.raises(GeometryError, match="by --holes: the widest of its holes is 1.414 wide"):
        read_surfaces(obj(tmp_path / "a.obj", corners(), faces=CUBE[1:]), 1.0)
    fin = np.array([*corners(), (0.5, -1, 0.5)])
    with pytest.raises(GeometryError, match="close it where it was made$"):
        read_surfaces(obj(tmp_path / "b.obj", fin, faces=[*CUBE, (1, 2, 9)]), 1.0)


@pytest.mark.parametrize("far", [9e4, 2e6])
def test_bodies_far_from_the_origin_are_moved_there_and_keep_their_joint(tmp_path, far):
    shift = np.array([far, -far / 7, 300.0])
    pair = [corners((0, 0, 0.13 * k), (0.6, 0.2, 0.13)) + shift for k in range(2)]
    solids = read_surfaces(obj(tmp_path / "far.obj", *pair), 1.0, flat=1e-4)
    (note,) = solids.notes
    assert f"{far:.3g} m from the origin" in note and f"rounded to {far * 2**-24 * 1e3:.2g} mm" in note
    assert np.abs(solids.blocks.points).max() < 2.0
    assert find_joints(solids.blocks).area.sum() == pytest.approx(0.12, rel=1e-6)
