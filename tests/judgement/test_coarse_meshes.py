"""The error of a mesh of constant-strain tets, as its own stress tells it, against closed forms of beams."""

import re
from functools import cache

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.estimates.meshes.stress_error import mesh_error, recovered, tet_stresses
from masonry.judgement.doubt import Doubt
from masonry.judgement.judgement import judgement_of
from masonry.laboratory import laboratory
from masonry.model.layout import tet_gradients, tet_volumes
from tests.scenes import box, listed, load, specimen, tables

YOUNG, NU, DENSITY, SIDE, LENGTH, SIDEWAYS = 10e9, 0.2, 2000.0, 0.2, 1.0, 0.5
BENDING = YOUNG * SIDE**4 / 12.0
SHEAR = YOUNG / (2.0 * (1.0 + NU)) * SIDE**2 * 5.0 * (1.0 + NU) / (6.0 + 5.0 * NU)
LINE = DENSITY * SIDE**2 * SIDEWAYS
STIFF = "1e13 Pa/m"


def scene(size: str, more: str, stiffness: str = STIFF, others: tuple[str, ...] = (), length: float = LENGTH):
    """A meshed cantilever that stands on a rigid block."""
    parts = [
        box("base", (0, 0, -SIDE), (SIDE, SIDE, SIDE), "stone", 0),
        box("b", (0, 0, 0), (SIDE, SIDE, length), "units", 1),
        *others,
    ]
    material = f'density = "{DENSITY} kg/m^3"\nyoung_modulus = "{YOUNG} Pa"\npoisson_ratio = {NU}'
    contact = f'normal_stiffness = "{stiffness}"\nshear_stiffness = "{stiffness}"'
    return load(
        'law = "elastic"\nkinematics = {default = "tets", stone = "rigid"}\n'
        + specimen(parts, SIDE**2, size)
        + tables("material", {"units": material, "stone": material})
        + tables("contact", {"stone_units": contact})
        + listed("support", ['on = "base"\nfix = "all"'])
        + more
        + listed("gauge", ['name = "tip"\nat = "b.z+"\ndirection = "x"'])
    )


def leaning(size: str, more: str = "", **parts):
    """The cantilever under a weight that acts sideways."""
    return scene(size, f'[gravity]\nx = "{SIDEWAYS} m/s^2"\n{more}', **parts)


@cache
def leant(size: str):
    return laboratory.run(leaning(size))


def told(result) -> list[Doubt]:
    return [doubt for doubt in judgement_of(result.summary).doubts if doubt.name == "coarse_mesh"]


@pytest.mark.parametrize("size", ["200 mm", "100 mm", "60 mm"])
def test_a_cantilever_is_told_to_bend_too_little_by_what_it_lacks_against_the_beam(size):
    tip = LINE * LENGTH**4 / (8.0 * BENDING) + LINE * LENGTH**2 / (2.0 * SHEAR)
    lacks = 1.0 - leant(size).history.rows["tip"][-1] / tip
    (doubt,) = told(leant(size))
    assert lacks / 1.5 < doubt.value < 1.5 * lacks and lacks > 0.1
    assert f"{100.0 * doubt.value:.2g} % too little" in doubt.sentence


def test_a_joint_that_is_soft_beside_its_block_lets_its_mesh_pass():
    assert told(laboratory.run(leaning("100 mm", stiffness="1e9 Pa/m"))) == []


def test_a_pressure_does_not_hide_that_a_block_is_bent_on_top_of_it():
    moved = 1e-5
    more = listed("support", ['on = "z = 1 m"\nfix = ["y"]'])
    more += listed("traction", ['on = "z = 1 m"\nstress = {z = "-5 MPa"}'])
    more += f'[drive]\non = "z = 1 m"\ndirection = "x"\ndisplacement = "{moved} m"\naccuracy = 0.02\n'
    result = laboratory.run(scene("100 mm", more))
    (doubt,) = told(result)
    beam = 1.0 / (LENGTH**3 / (3.0 * BENDING) + LENGTH / SHEAR)
    rows = result.history.rows
    settled = np.flatnonzero(rows["displacement"] == 0.0)[-1]  # a mesh that is not even pushes aside what is pressed
    lacks = 1.0 - beam * moved / (rows["force"][-1] - rows["force"][settled])
    assert "on the way to the peak" in doubt.sentence and lacks / 1.5 < doubt.value < 1.5 * lacks


def test_a_block_that_bends_beside_one_that_stores_much_more_is_named():
    beside = box("beside", (1.0, 0, 0), (SIDE, SIDE, SIDE), "units", 2)
    below = box("below", (1.0, 0, -SIDE), (SIDE, SIDE, SIDE), "stone", 3)
    more = listed("traction", ['on = "beside.z+"\nstress = {z = "-40 kPa"}'])
    more += listed("support", ['on = "below"\nfix = "all"'])
    (doubt,) = told(laboratory.run(leaning("100 mm", more, others=(below, beside))))
    assert "block 1 at" in doubt.sentence
    assert doubt.value == pytest.approx(told(leant("100 mm"))[0].value, rel=0.1)


@cache
def mesh():
    return assemble(leaning("60 mm")).mesh


LAME = np.array([YOUNG * NU / ((1.0 + NU) * (1.0 - 2.0 * NU)), YOUNG / (2.0 * (1.0 + NU))])


def lame():
    return np.tile(LAME, (len(mesh().tets), 1))


def test_an_even_stress_has_no_error_and_a_linear_one_is_recovered_as_it_is():
    even = mesh().nodes @ np.random.default_rng(1).normal(size=(3, 3)) * 1e-4
    stored, error = mesh_error(mesh(), tet_stresses(mesh(), even, lame()), lame())
    assert error.sum() < 1e-20 * stored.sum()
    slopes = np.random.default_rng(2).normal(size=(3, 6))
    middle = mesh().nodes[mesh().tets].mean(axis=1)
    at_nodes = recovered(mesh(), 1.0 + middle @ slopes, tet_volumes(mesh()))
    assert at_nodes == pytest.approx(1.0 + mesh().nodes @ slopes, abs=1e-8)


def test_energy_and_error_are_those_of_the_integrals_and_stay_where_all_turns():
    x, y, z = mesh().nodes.T
    bent = 1e-5 * np.column_stack([-0.5 * z**2, 0.0 * y, (x - 0.1) * z])
    stress = tet_stresses(mesh(), bent, lame())
    stored, error = mesh_error(mesh(), stress, lame())
    strain = np.einsum("tai,taj->tij", bent[mesh().tets], tet_gradients(mesh()))
    strain = 0.5 * (strain + strain.transpose(0, 2, 1))
    work = stress[:, :3] * np.einsum("tii->ti", strain)
    shear = stress[:, 3:] * np.stack([strain[:, i, j] for i, j in ((1, 2), (0, 2), (0, 1))], axis=1)
    assert stored == pytest.approx(tet_volumes(mesh()) * (0.5 * work + shear).sum(axis=1), rel=1e-9)
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    turned = (mesh().nodes + bent) @ turn.T - mesh().nodes
    large = mesh_error(mesh(), tet_stresses(mesh(), turned, lame(), large=True), lame())
    assert large[0].sum() == pytest.approx(stored.sum(), rel=1e-3)
    assert large[1].sum() == pytest.approx(error.sum(), rel=1e-3)


@pytest.mark.parametrize("size", ["200 mm", "100 mm", "60 mm"])
def test_modes_tell_by_how_much_their_frequencies_are_too_high(size):
    modes = masonry.modes(leaning(size), 2)
    beam = 1.8751**2 / (2.0 * np.pi) * np.sqrt(BENDING / (DENSITY * SIDE**2 * LENGTH**4))
    beam *= 0.98  # shear and the inertia of turning, by the series of Timoshenko's beam
    high = modes.frequencies[0] / beam - 1.0
    (said,) = [line for line in modes.remarks if "tets" in line]
    assert high / 1.5 < float(re.search(r"about ([\d.]+) % in mode 1", said)[1]) / 100.0 < 1.5 * high


def test_the_mesh_that_is_proposed_would_do():
    (said,) = [line for line in masonry.modes(leaning("60 mm", length=0.4), 1).remarks if "tets" in line]
    finer = re.search(r'"(\d+ mm)"', said)[1]
    assert not [line for line in masonry.modes(leaning(finer, length=0.4), 1).remarks if "tets" in line]


DRY = 'law = "friction"\nnormal_stiffness = "30 GPa/m"\nshear_stiffness = "12 GPa/m"\ntan_friction_angle = '
SLENDER = (0.5, 0.3, 1.0)


def pushed_over(law: str, more: str, size: tuple[float, float, float] = SLENDER):
    """A coarsely meshed block on a rigid one, and what is told of its mesh."""
    material = f'density = "{DENSITY} kg/m^3"\nyoung_modulus = "{YOUNG} Pa"\npoisson_ratio = {NU}'
    parts = [box("base", (-1, 0, -1), (3, 0.3, 1), "stone", 0), box("b", (0, 0, 0), size, "units", 1)]
    return laboratory.run(
        load(
            'kinematics = {default = "tets", stone = "rigid"}\n'
            + specimen(parts, 1.0, "250 mm")
            + tables("material", {"units": material, "stone": material})
            + tables("contact", {"stone_units": law})
            + listed("support", ['on = "base"\nfix = "all"'])
            + f'[gravity]\nz = "-10 m/s^2"\n{more}'
        )
    )


def test_a_factor_that_dry_joints_bear_does_not_rest_on_the_mesh_and_one_that_did_not_fall_does():
    grows = '[limit]\npattern = "weight"\ndirection = "x"\naccuracy = "1 %"\n'
    result = pushed_over(DRY + "0.7", grows)
    factor = result.summary["collapse_load"]
    assert factor["borne"] <= 0.5 * 1.005 and factor["falls"] >= 0.5 * 0.995 and result.verdict == "sound"
    assert told(pushed_over(DRY + "0.7", grows + "up_to = 0.45\n"))
