"""Frequencies, effective masses and shapes against closed forms; the stiffness against that of the compiled step."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import block_diag, csc_array, csr_array

import masonry
from masonry.assembly.assemble import assemble
from masonry.modal_analysis.eigen import dominant, factorised, slowest
from masonry.modal_analysis.oscillator import oscillator_of
from verification.fixtures.models import SMALL, acceleration_matrix, free, mass_vector
from verification.references.swinging_stack import STACK, keys_of
from verification.scene_runs import load


@pytest.mark.parametrize("count", [1, 4])
def test_a_stack_has_the_frequencies_of_its_transfer_matrices(count):
    stack = replace(STACK, count=count)
    modes = masonry.modes(load("stack", keys_of(stack)), 6 * count)
    across = replace(stack, width=stack.depth, depth=stack.width)
    twist = np.sqrt((stack.ks / stack.kn) * (stack.turning + across.turning) / (stack.kn * stack.area))
    turns = stack.up_and_down() * twist / np.sqrt((stack.width**2 + stack.depth**2) / 12.0)
    known = [*stack.up_and_down(), *turns]
    known += [f for plane in (stack, across) for f in plane.sideways(2 * count)]
    assert modes.frequencies == pytest.approx(np.sort(known), rel=1e-9)


def test_a_tall_stack_is_a_timoshenko_beam():
    stack = replace(STACK, count=60)
    modes = masonry.modes(load("stack", keys_of(stack)), 12)
    along = modes.frequencies[modes.share[:, 0] > 1e-3]
    assert along[:3] == pytest.approx(stack.beam(3), rel=1e-3)
    assert along[:3] == pytest.approx(stack.sideways(3), rel=1e-8)


def test_all_modes_together_move_all_of_the_mass():
    modes = masonry.modes(load("stack", keys_of(STACK)), 24)
    assert modes.effective_mass.sum(axis=0) == pytest.approx(4 * STACK.mass * np.ones(3))
    assert modes.mass == pytest.approx(4 * STACK.mass * np.ones(3))
    assert np.abs(modes.corners).max(axis=(1, 2)) == pytest.approx(np.ones(24), abs=0.5)


def test_the_stiffness_is_that_of_the_compiled_step_for_all_kinds_of_blocks():
    scene = load("energy-of-all-kinds", {"law": "elastic", "solver.masses": "real"})
    oscillator, model = oscillator_of(scene), assemble(scene).model
    moves = np.flatnonzero(free(model))
    assert mass_vector(model)[moves] == pytest.approx(oscillator.mass[moves], rel=1e-14)
    strain = oscillator.strain_matrix[:, moves]
    stiffness = (strain.T @ strain).toarray()
    compiled = -acceleration_matrix(model) * oscillator.mass[moves, None]
    assert SMALL < 1e-5 and compiled == pytest.approx(stiffness, abs=1e-9 * np.abs(stiffness).max())


def test_rayleigh_damping_has_its_ratio_at_both_modes():
    modes = masonry.modes(load("stack", keys_of(STACK)), 4, ratio=0.03, between=(2, 4))
    mass, stiffness = modes.rayleigh
    for frequency in modes.frequencies[[1, 3]]:
        omega = 2.0 * np.pi * frequency
        assert mass / (2.0 * omega) + stiffness * omega / 2.0 == pytest.approx(0.03)


def springs(square, seed=1):
    """A matrix B whose modes have some square frequencies (n,) and shapes along all axes."""
    turns = np.linalg.qr(np.random.default_rng(seed).standard_normal((len(square), len(square))))[0]
    return csr_array(np.sqrt(square)[:, None] * turns)


@pytest.mark.parametrize(
    ("lowest", "count"), [(1, 6), (2, 6), (12, 12), (13, 6), (100, 12), (400, 12)], ids=lambda number: f"{number}"
)
def test_equal_frequencies_are_all_found(lowest, count):
    """Equal springs, sixty equal stiffer ones, and others: each copy counts, fewer or more than are asked for."""
    square = np.concatenate([np.full(lowest, 1.0), np.full(60, 2.0), np.linspace(3.0, 50.0, 400)])[:400]
    modes = slowest(springs(square), np.ones(400), np.ones(400, dtype=bool), count)
    assert modes.square == pytest.approx(square[:count], rel=1e-12) and len(modes.loose) == 0
    assert modes.shape @ modes.shape.T == pytest.approx(np.eye(count), abs=1e-12)
    residual = springs(square).T @ (springs(square) @ modes.shape.T) - modes.square * modes.shape.T
    assert np.abs(residual).max() < 1e-6, "each is a mode"


@pytest.mark.parametrize("seed", range(5))
def test_what_is_found_does_not_hang_on_where_the_search_begins(seed):
    """Twelve equal motions that nothing holds, five nearly equal modes, and thirty equal ones, from any start; and from
    one that has no part of the lowest modes."""
    square = np.concatenate([np.zeros(12), 1.0 + 1e-7 * np.arange(5), np.full(30, 7.0), np.geomspace(8.0, 1e6, 300)])
    matrix = csc_array(springs(square).T @ springs(square))
    solve, start = factorised(matrix, 1e-5), np.random.default_rng(seed).standard_normal((len(square), 28))
    low = springs(square)[12:17].toarray()
    for first in (start, start - low.T @ np.linalg.solve(low @ low.T, low @ start)):
        vectors = dominant(solve, first, 1e6)[:, :20]
        quotient = ((springs(square) @ vectors) ** 2).sum(axis=0)
        assert quotient[:12] == pytest.approx(np.zeros(12), abs=1e-10)
        assert quotient[12:] == pytest.approx(square[12:20], rel=1e-8)


def test_slow_modes_of_chains_whose_masses_differ_by_nine_decades_are_those_of_each_chain():
    """60 chains of 6 masses, each held at an end: frequencies that lie close together beside stiffnesses that are 10^10
    times theirs."""
    chain = 1e6 * (np.eye(6) - np.eye(6, k=-1))
    mass = np.geomspace(1e-3, 1e6, 360)
    each = [np.linalg.svd(chain / np.sqrt(own), compute_uv=False) ** 2 for own in mass.reshape(60, 6)]
    modes = slowest(csr_array(block_diag([chain] * 60)), mass, np.ones(360, dtype=bool), 20)
    assert modes.square == pytest.approx(np.sort(np.concatenate(each))[:20], rel=1e-4)


def test_a_matrix_without_any_stiffness_has_loose_motions_alone():
    modes = slowest(csr_array((5, 300)), np.ones(300), np.ones(300, dtype=bool), 6)
    assert len(modes.square) == 0 and len(modes.loose) > 60 and not modes.all_loose


def test_parts_that_nothing_holds_are_told_and_left_out():
    free_stack = {"support": [], "floor": {"level": "-10 m"}, "displacements": "large", "gravity": {"z": "-9.81 m/s^2"}}
    settle = {"settle.steps": 0, "contact.default": {"normal_stiffness": "1 GPa/m", "shear_stiffness": "0.5 GPa/m"}}
    scene = load("stack", keys_of(STACK) | free_stack | settle)
    modes = masonry.modes(scene, 3)
    assert modes.loose == 6 and len(modes.loose_blocks) == 5 and len(modes.frequencies) == 3
    assert "6 motions that no joint resists" in str(modes)
    slowest_chain = 2.0 * np.sqrt(STACK.kn * STACK.area / STACK.mass) * np.sin(np.pi / 10.0) / (2.0 * np.pi)
    assert np.isclose(masonry.modes(scene, 24).frequencies, slowest_chain).any(), "five masses on four springs"


def test_the_order_of_blocks_and_the_place_of_the_specimen_do_not_matter():
    here = masonry.modes(load("stack", keys_of(STACK)), 6)
    far = keys_of(STACK)
    for entry in far["specimen.box"]:
        entry["origin"] = [f"{float(x.split()[0]) + 1e4!r} m" for x in entry["origin"]]
    far["specimen.box"] = far["specimen.box"][::-1]
    assert masonry.modes(load("stack", far), 6).frequencies == pytest.approx(here.frequencies, rel=1e-7)
