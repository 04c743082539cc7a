"""Dashpots of meshed blocks: what a mesh changes, which is nothing, and the step that is proven for them."""

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.scene import Scene
from tests.large.made import DENSITY, STIFF
from tests.scenes import box, listed, load, specimen, tables
from verification.fixtures.dry_blocks import restitution

EDGE, SLAB = 0.1, (0.5, 0.5, 0.05)
RIGID = "100 GPa"
"""A hundred times as stiff over an edge as the joint is."""


def hit(
    zeta: float,
    mesh: str = 'mesh = "fan"',
    young: str = RIGID,
    more: str = "",
    twins: bool = False,
) -> Scene:
    """A meshed cube that flies at a held slab, or at a cube like itself, without weight."""
    other = box("slab", (0.0, 0.0, -SLAB[2]), SLAB, "units", 0)
    if twins:
        other = box("slab", (0.2, 0.2, -EDGE), (EDGE,) * 3, "meshed", 0)
    boxes = [other, box("block", (0.2, 0.2, 1e-4), (EDGE,) * 3, "meshed", 1)]
    material = f'density = "{DENSITY} kg/m^3"\nyoung_modulus = "{young}"\npoisson_ratio = 0.2'
    contact = (
        f'normal_stiffness = "{STIFF}"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = 0.3\nnormal_dashpot = {zeta}'
    )
    return load(
        'displacements = "large"\nlaw = "friction"\nkinematics = {default = "rigid", meshed = "tets"}\n'
        + specimen(boxes, 0.01, mesh_size="50 mm", more=mesh)
        + tables("material", dict.fromkeys(("meshed",) if twins else ("units", "meshed"), material))
        + tables("contact", {"default": contact})
        + listed("support", [] if twins else ['on = "slab"\nfix = "all"'])
        + listed("motion", ['on = "block"\nvelocity = [0, 0, "-1 m/s"]'])
        + f'[solver]\nmasses = "real"\ndamping = 0\nduration = "1 ms"\nrows = 100\n{more}'
    )


def kept(bounce: Scene) -> float:
    """Speed after over before an impact."""
    rows = laboratory.run(bounce).history.rows
    assert np.abs(rows["imbalance"]).max() < 1e-11 * rows["kinetic"][0]
    return float(np.sqrt(rows["kinetic"][-1] / rows["kinetic"][0]))


@pytest.mark.parametrize("mesh", ['mesh = "fan"', ""])
@pytest.mark.parametrize("zeta", [0.1, 0.4])
def test_a_stiff_cube_bounces_as_a_rigid_one_whatever_its_mesh(zeta, mesh):
    """The masses behind a face of either block are in series."""
    behind = EDGE, float(np.cbrt(np.prod(SLAB)))
    of_the_cube = zeta * np.sqrt(behind[1] / (behind[0] + behind[1]))
    assert kept(hit(zeta, mesh, more="step_fraction = 0.3")) == pytest.approx(restitution(of_the_cube), rel=0.006)


def energy(rows: dict) -> np.ndarray:
    """Kinetic and elastic (J), of all blocks and contacts."""
    return np.sum([rows[key] for key in ("kinetic", "elastic_blocks", "elastic_contacts")], axis=0)


@pytest.mark.parametrize("zeta", [0.3, 1.0])
def test_the_proven_step_is_stable_with_dashpots_of_a_soft_mesh(zeta):
    rows = laboratory.run(hit(zeta, "", "1 GPa", more="step_fraction = 0.99", twins=True)).history.rows
    assert np.all(np.diff(energy(rows)) < 1e-6 * rows["kinetic"][0])
    assert rows["dashpot"][-1] > 0.1 * rows["kinetic"][0]


def test_dashpots_of_meshed_blocks_with_scaled_masses_are_refused_in_one_sentence():
    dashpot = {"displacements": "large", "kinematics": "tets", "contact.unit_unit.normal_dashpot": 0.5}
    with pytest.raises(SceneError, match='^normal_dashpot of blocks of kinematics .* needs solver.masses = "real"'):
        laboratory.run(scene.load("couplet", dashpot))
