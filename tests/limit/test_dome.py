"""A dome of voussoirs in space: a hemisphere stands from a thickness of 0.042 radii on (Heyman 1967)."""

import numpy as np
import pytest

from geometry.blocks import Blocks
from geometry.polyhedra.construct import from_faces
from masonry.statics.solve import STANDS, largest_factor, standing
from tests.limit.blocks import CONES, dry

SIDES = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
"""Of a body with corner 4 k + 2 i + j at the ends k, i, j of three edges."""


def faces(corners: np.ndarray) -> list[np.ndarray]:
    """Of a body with eight corners (8, 3), counter-clockwise seen from outside."""
    found = []
    for side in SIDES:
        face = corners[list(side)]
        normal = np.cross(face[1] - face[0], face[2] - face[0])
        found.append(face if normal @ (face.mean(axis=0) - corners.mean(axis=0)) > 0 else face[::-1])
    return found


def dome(thickness: float, courses: int, sectors: int) -> tuple[Blocks, np.ndarray]:
    """Courses of voussoirs of mean radius 1 m without bond, a small opening at the top; and the blocks it stands on."""
    radius = 1.0 + thickness * np.array([-0.5, 0.5])
    steep = np.linspace(0.5 * np.pi, 0.1, courses + 1)
    round_about = 2 * np.pi * np.arange(sectors + 1) / sectors
    r, s, p = np.meshgrid(radius, steep, round_about, indexing="ij")
    place = np.stack([r * np.sin(s) * np.cos(p), r * np.sin(s) * np.sin(p), r * np.cos(s)], axis=-1)
    bodies = [place[:, i : i + 2, j : j + 2].reshape(8, 3) for j in range(sectors) for i in range(courses)]
    below = [place[:, :1, j : j + 2] - np.array([[[0.0, 0.0, 0.0]], [[0.0, 0.0, 0.1]]])[None] for j in range(sectors)]
    bodies += [np.asarray(body).reshape(8, 3) for body in below]
    number = len(bodies)
    blocks = from_faces([faces(body) for body in bodies], range(number), [0] * number, ("units",))
    return blocks, np.arange(courses * sectors, number)


@pytest.mark.parametrize(("thickness", "stands"), [(0.0412, False), (0.0425, True)])
def test_a_hemisphere_of_480_voussoirs_stands_from_its_least_thickness_on(thickness, stands):
    found = standing(*dry(*dome(thickness, 20, 24), 0.7), CONES)
    assert (found.factor >= STANDS) == stands


def test_a_dome_falls_alike_whichever_way_it_is_pushed():
    blocks, held = dome(0.06, 8, 12)
    pushed = [
        largest_factor(*dry(blocks, held, 0.7, live=(np.cos(a), np.sin(a), 0.0))) for a in (0.0, np.pi / 6, np.pi)
    ]
    assert [found.factor for found in pushed] == pytest.approx([pushed[0].factor] * 3, rel=1e-6)
    assert max(found.gap for found in pushed) < 1e-6
