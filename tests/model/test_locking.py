"""How much too stiff constant-strain tets are as Poisson's ratio nears 0.5, against quadratic tets on the same mesh."""

import numpy as np
import pytest
from skfem import Basis, ElementTetP1, ElementTetP2, ElementVector, MeshTet, asm, condense, solve
from skfem.models.elasticity import lame_parameters, linear_elasticity

from masonry.assembly.assemble import assemble
from masonry.configuration import energy
from masonry.laboratory import laboratory
from masonry.laboratory.remarks.scenes.locking import LOCKED
from tests.scenes import ELASTIC, box, listed, load, specimen, tables

YOUNG, SIDE = 5e9, 0.1


def cube(nu, kinematics="tets"):
    """A cube of 100 mm, four tets across, between two thin plates."""
    parts = [
        box("low", (0, 0, -0.01), (SIDE, SIDE, 0.01), "ends", 1),
        box("cube", (0, 0, 0), (SIDE, SIDE, SIDE), "units", 2),
        box("high", (0, 0, SIDE), (SIDE, SIDE, 0.01), "ends", 3),
    ]
    material = f'density = "1900 kg/m^3"\nyoung_modulus = "5 GPa"\npoisson_ratio = {nu!r}'
    return load(
        f'kinematics = {{default = "rigid", units = "{kinematics}"}}\n'
        + specimen(parts, SIDE**2, "25 mm")
        + tables("material", {"units": material, "ends": material})
        + tables("contact", {"ends_units": ELASTIC})
        + listed("support", ['on = "low"\nfix = "all"', 'on = "high"\nfix = ["x", "y", "rotation"]'])
        + '[drive]\non = "high"\ndirection = "-z"\ndisplacement = "0.1 mm"\n'
    )


def solution(mesh, nu, element, moved):
    """Displacements (3 N,) and twice the energy where the top moves by one along an axis and the bottom is held."""
    basis = Basis(mesh, ElementVector(element), intorder=2)
    stiffness = asm(linear_elasticity(*lame_parameters(YOUNG, nu)), basis).tocsc()
    ends = [basis.get_dofs(lambda x, z=z: np.isclose(x[2], z)) for z in (0.0, SIDE)]
    u = np.zeros(stiffness.shape[0])
    u[ends[1].all([f"u^{moved + 1}"])] = 1.0
    held = np.concatenate([end.all() for end in ends])
    u = solve(*condense(stiffness, np.zeros_like(u), u, D=held))
    return u, float(u @ (stiffness @ u))


def excess(assembly, nu, moved):
    """By how much constant strains are stiffer than linear ones; the program's own tets hold the same energy."""
    members = assembly.mesh
    mesh = MeshTet(np.ascontiguousarray(members.nodes.T), np.ascontiguousarray(members.tets.T))
    u, twice = solution(mesh, nu, ElementTetP1(), moved)
    assembly.model.contacts.u[: len(members.nodes)] = u.reshape(-1, 3)
    assert 2.0 * energy.observe(assembly.model).elastic_blocks == pytest.approx(twice, rel=1e-9)
    return twice / solution(mesh, nu, ElementTetP2(), moved)[1] - 1.0


@pytest.mark.parametrize(("nu", "rel"), [(0.3, 0.05), (0.45, 0.05), (0.4999, 0.15)])
def test_the_figures_of_the_warning_are_those_of_a_cube_with_four_tets_across(nu, rel):
    """Another mesh of the same size moves them by 1 %, and by 10 % where a few tets hold all of the volume."""
    assembly = assemble(cube(nu))
    shear, _, pressed = dict(LOCKED)[nu]
    assert excess(assembly, nu, 0) == pytest.approx(shear, rel=rel)
    assert excess(assembly, nu, 2) == pytest.approx(pressed, rel=rel)


def test_the_warning_gives_the_figures_of_the_next_ratio_in_the_table():
    said = laboratory.check(cube(0.42))["warnings"]
    assert len(said) == 1
    assert "0.42" in said[0] and "16 % in shear, 30 % in bending, 23 % pressed between plates" in said[0]
    assert laboratory.check(cube(0.3))["warnings"] == []
    assert laboratory.check(cube(0.4999, "affine"))["warnings"] == []  # one strain a block: nothing locks
    assert "60 times" in laboratory.check(cube(0.4999))["warnings"][0]
