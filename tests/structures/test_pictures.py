"""Pictures of structures: seen from where they show, without the creases of curved faces, names that find room."""

import numpy as np
import pytest

from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.structures.dome import dome
from masonry.assembly.specimens import specimen_of
from masonry.drawings.geometry_picture import camera_for
from masonry.drawings.picture_frame import _shown
from masonry.pictures.hidden_surfaces import unit_edges
from masonry.scene import load


@pytest.mark.parametrize(
    ("name", "oblique"),
    [
        *(("dome-own-weight", True), ("vault-spreading", True), ("facade-tilted", True), ("wall-out-of-plane", True)),
        *(("arch-own-weight", False), ("arch-tilted", False), ("wall-with-window", False), ("column-pushed", False)),
    ],
)
def test_what_the_front_does_not_show_is_seen_obliquely(name, oblique):
    scene = load(name)
    assert camera_for(scene, specimen_of(scene), None).along_an_axis == (not oblique)
    assert camera_for(scene, specimen_of(scene), "front").along_an_axis


def test_the_crease_in_the_middle_of_a_voussoir_is_no_edge_of_it():
    specimen = dome(1.0, 0.2, 3, 12, 0.3)
    _, normal, centroid = face_areas_normals_centroids(specimen.blocks)
    outer = np.einsum("fi,fi->f", normal, centroid) > 0.5
    outer &= np.isin(specimen.blocks.face_block(), specimen.sets["voussoirs"])
    faces = np.flatnonzero(outer)
    assert len(faces) == 2 * 36
    edges = unit_edges(specimen.blocks, faces, normal)
    assert np.all(edges.reshape(len(faces), 4).sum(axis=1) == 3), "of four edges the crease is none"


def test_of_a_long_row_of_numbered_sets_the_first_and_the_last_are_named():
    names = [f"course {k}" for k in range(1, 9)] + ["base", "drum 1", "drum 2"]
    assert _shown(names) == ["course 1", "course 8", "base", "drum 1", "drum 2"]
