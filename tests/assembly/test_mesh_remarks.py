"""What is told of meshes: inertia that is too large, as it is, and edges that sink into what they meet."""

import numpy as np
import pytest

from geometry.polyhedra.construct import from_faces
from geometry.polyhedra.measures import sharpest_edge
from masonry.assembly.assemble import assemble
from masonry.estimates.meshes.inertia import inertia_excess
from masonry.laboratory.remarks.scenes.mesh_inertia import doubts
from masonry.scene import Scene
from tests.large.made import slab
from tests.large.test_meshed_blocks import scene
from tests.scenes import box


def cube(size: str) -> Scene:
    """A meshed cube that flies, and one that deforms evenly."""
    boxes = [slab(), box("cube", (-0.1, -0.1, 0.1), (0.2, 0.2, 0.2), "meshed", 1)]
    boxes.append(box("beside", (0.5, -0.1, 0.1), (0.2, 0.2, 0.2), "bricks", 2))
    return scene(boxes, (0, 0, 0), 0.01, mesh="").with_({"specimen.mesh_size": size})


def prism(angle: float):
    """A wedge of unit length with an edge of some angle (deg) at its tip, pointing down."""
    half = np.tan(np.radians(0.5 * angle))
    near = np.array([[0.0, 0.0, 0.0], [half, 0.0, 1.0], [-half, 0.0, 1.0]])
    far = near + [0.0, 1.0, 0.0]
    sides = [np.array([near[j], near[i], far[i], far[j]]) for i, j in ((0, 1), (1, 2), (2, 0))]
    return from_faces([[near, far[::-1], *sides]], np.zeros(1, dtype=int), np.zeros(1, dtype=int), ("units",))


def test_the_excess_of_inertia_is_that_of_the_masses_at_the_nodes_and_falls_with_the_mesh():
    excesses = []
    for size in ("100 mm", "25 mm"):
        built = assemble(cube(size))
        excess = inertia_excess(built.mesh, built.model.layout.centroid)[1]
        arm = built.mesh.nodes - built.model.layout.centroid[1]
        about_z = built.model.masses["tets"][:, 0] @ (arm[:, 0] ** 2 + arm[:, 1] ** 2)
        assert about_z == pytest.approx((1.0 + excess) * 2000.0 * 0.2**5 / 6.0, rel=0.02), "alike about all axes"
        excesses.append(excess)
    assert 0.05 < excesses[0] < 0.5 and excesses[1] < excesses[0] / 5.0, (
        "less than the square of 4: coarse meshes are not alike"
    )


@pytest.mark.parametrize(("size", "told"), [("100 mm", True), ("25 mm", False)])
def test_a_mesh_that_is_too_heavy_to_turn_is_told(size, told):
    raised = doubts(assemble(cube(size)))
    assert len(raised) == told and all("too much rotational inertia" in doubt.sentence for doubt in raised)


@pytest.mark.parametrize("angle", [20.0, 60.0, 100.0])
def test_the_sharpest_edge_is_found(angle):
    block, sharpest = sharpest_edge(prism(angle), np.ones(1, dtype=bool))
    assert block == 0 and sharpest == pytest.approx(min(angle, 90.0 - 0.5 * angle), abs=1e-6)
