from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from geometry.blocks import Blocks
from geometry.polyhedra.construct import from_faces


def _rotate(blocks, degrees, axis=(1.0, 2.0, 0.5), shift=(0.3, -0.2, 0.7)):
    turn = Rotation.from_rotvec(np.radians(degrees) * np.asarray(axis) / np.linalg.norm(axis))
    return replace(blocks, points=turn.apply(blocks.points) + shift), turn.as_matrix()


def _hull(points) -> Blocks:
    hull = ConvexHull(points)
    faces = []
    for simplex, plane in zip(hull.simplices, hull.equations, strict=True):
        face = points[simplex]
        outward = np.cross(face[1] - face[0], face[2] - face[0]) @ plane[:3] > 0
        faces.append(face if outward else face[::-1])
    return from_faces([faces], [0], [0], ["units"])


def _prism(polygon, low, high):
    """Faces of a prism over a counter-clockwise polygon (n, 2)."""
    bottom, top = (np.column_stack([polygon, np.full(len(polygon), z)]) for z in (low, high))
    following = np.roll(np.arange(len(polygon)), -1)
    sides = [np.array([bottom[i], bottom[j], top[j], top[i]]) for i, j in enumerate(following)]
    return [bottom[::-1], top, *sides]


@pytest.fixture
def rotate():
    return _rotate


@pytest.fixture
def hull():
    return _hull


@pytest.fixture(scope="session")
def prism():
    return _prism


@pytest.fixture
def tet_volumes():
    def volumes(mesh):
        edge = mesh.nodes[mesh.tets[:, 1:]] - mesh.nodes[mesh.tets[:, :1]]
        return np.einsum("ti,ti->t", edge[:, 0], np.cross(edge[:, 1], edge[:, 2])) / 6

    return volumes
