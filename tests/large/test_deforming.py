"""Affine blocks among rigid ones in large displacement: they slide and topple, spin and hit, and nothing gets lost."""

from functools import cache
from math import cos, hypot, radians, sin

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration import model_state
from masonry.configuration.chunk import Chunk
from masonry.laboratory import laboratory
from masonry.laboratory.remarks.runs.deformed_blocks import of_strains
from masonry.monitors.collapse import LargestDeformation
from masonry.monitors.observer import View
from masonry.timeloop.compiled_step import advance_model
from tests.large.made import DENSITY, G, leaning, slab
from tests.scenes import box, listed, load, specimen, tables

STIFF, SOFT = "10 GPa/m", "0.5 GPa"
SLOPE = 25.0
LEAN = leaning(SLOPE)
GAUGES = "".join(f'[[gauge]]\nname = "{axis}"\nat = "block"\ndirection = "{axis}"\n' for axis in "xyz")


def scene(boxes, friction=0.3, gravity=LEAN, young="10 GPa", duration=0.3, turned="", more="", held=True):
    """Boxes of group `bricks` are affine, those of group `units` rigid: all of this file is one compiled kind."""
    down = "\n".join(f'{axis} = "{part!r} m/s^2"' for axis, part in zip("xyz", map(float, gravity), strict=True))
    contact = (
        f'normal_stiffness = "{STIFF}"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = {friction}\n'
        "normal_dashpot = 0.5"
    )
    material = f'density = "{DENSITY} kg/m^3"\nyoung_modulus = "{young}"\npoisson_ratio = 0.2'
    return load(
        'displacements = "large"\nlaw = "friction"\nkinematics = {default = "rigid", bricks = "affine"}\n'
        + specimen(boxes, 0.01, more=turned)
        + tables("material", {"units": material, "bricks": material})
        + tables("contact", {"default": contact})
        + listed("support", ['on = "slab"\nfix = "all"'] if held else [])
        + f"[gravity]\n{down}\n[settle]\nsteps = 0\n"
        + f'[solver]\nmasses = "real"\ndamping = 0\nduration = "{duration} s"\nrows = 200\n{more}'
    )


def on_a_slope(half=0.1, high=0.05, **settings):
    block = box("block", (-half, -0.1, 0.0), (2.0 * half, 0.2, 2.0 * high), "bricks", 1)
    return scene([slab(), block], **settings)


@cache
def sliding():
    return laboratory.run(on_a_slope(more=GAUGES))


def test_a_stiff_block_slides_as_a_rigid_one_does():
    rows, lean = sliding().history.rows, radians(SLOPE)
    pace = G * (sin(lean) - 0.3 * cos(lean))
    after = rows["time"] > 0.1
    wanted = 0.5 * pace * rows["time"] ** 2
    assert rows["x"][after] == pytest.approx(wanted[after], abs=0.02 * wanted[-1])
    weight = DENSITY * 0.2 * 0.2 * 0.1 * G
    assert rows["friction"][-1] == pytest.approx(0.3 * weight * cos(lean) * rows["x"][-1], rel=0.01)
    assert 0.0 < rows["elastic_blocks"].max() < 1e-3 * rows["kinetic"].max()


def test_the_ledger_closes_and_forces_add_up_while_it_slides():
    result = sliding()
    rows, summary = result.history.rows, result.summary
    assert np.abs(rows["imbalance"]).max() < 1e-12 * np.abs(rows["external_work"]).max()
    assert summary["dissipation_mismatch"] < 1e-4
    assert summary["force_balance"] < 1e-9
    assert summary["warnings"] == []
    assert summary["kinematics"] == "affine + rigid"


def test_a_stiff_block_topples_as_a_rigid_one_does():
    half, high = 0.05, 0.15
    result = laboratory.run(on_a_slope(half, high, friction=0.8, young="100 GPa", more=GAUGES))
    rows = result.history.rows
    time, slender = rows["time"], np.arctan2(half, high)
    turn = 0.5 * np.pi + slender - np.arctan2(rows["z"] + high, rows["x"] - half)
    pace = 0.75 * G / hypot(half, high) * np.sin(turn - slender + radians(SLOPE))
    spin = np.gradient(turn, time)
    late = np.flatnonzero(time > 0.1)
    gained = np.concatenate([[0.0], np.cumsum(0.5 * (pace[late[1:]] + pace[late[:-1]]) * np.diff(time[late]))])
    assert spin[late] - spin[late[0]] == pytest.approx(gained, abs=0.01 * gained[-1])
    assert result.summary["rotation_max_rad"] > 0.3
    assert result.summary["energy_imbalance"] < 1e-12


def test_the_scene_may_be_turned_by_a_right_angle():
    x, y, z = LEAN
    more = f'time_step = "4e-6 s"\n{GAUGES}'
    soft = {"young": SOFT, "duration": 0.1, "half": 0.125, "high": 0.0625}
    one = laboratory.run(on_a_slope(**soft, more=more)).history.rows
    turned = {"gravity": (z, y, -x), "turned": 'turned = {about = "y", angle = "90 deg"}'}
    other = laboratory.run(on_a_slope(**soft, **turned, more=more)).history.rows
    for key in ("kinetic", "elastic_blocks", "elastic_contacts", "friction"):
        assert other[key] == pytest.approx(one[key], rel=0, abs=1e-9 * np.abs(one[key]).max()), key
    assert other["z"] == pytest.approx(-one["x"], rel=0, abs=1e-9 * np.abs(one["x"]).max())


def advanced(model, steps: int) -> None:
    chunk = Chunk(np.ones(steps + 1), np.zeros(steps + 1), False)
    advance_model(model, chunk, 1, 0, steps, np.zeros(steps))


def flying(fraction=0.9):
    """A rigid and a soft block that fly at each other, askew and spinning, another one on the first."""
    boxes = [
        box("slab", (0.0, 0.0, 0.0), (0.2, 0.1, 0.1), "units", 0),
        box("block", (0.204, 0.03, 0.02), (0.1, 0.15, 0.12), "bricks", 1),
        box("rider", (0.05, 0.0, 0.1), (0.1, 0.1, 0.05), "bricks", 2),
    ]
    motion = (
        '[[motion]]\non = "slab"\nvelocity = ["2 m/s", 0, "0.2 m/s"]\nspin = ["1 rad/s", "3 rad/s", "2 rad/s"]\n'
        '[[motion]]\non = "block"\nvelocity = ["-1 m/s", "0.3 m/s", 0]\n'
    )
    return scene(boxes, 0.5, (0.0, 0.0, -G), SOFT, 0.02, more=f"step_fraction = {fraction}\n{motion}", held=False)


def angular_momentum(model) -> np.ndarray:
    """(3,) kg m2/s about the origin, of velocities half a step after the places."""
    rigid, affine, _ = model.bodies
    layout, momentum = model.layout, np.zeros(3)
    place = layout.centroid[layout.members["rigid"]] + rigid.q[:, :3]
    momentum += (np.cross(place, model.masses["rigid"][:, :3] * rigid.v[:, :3]) + rigid.momentum).sum(axis=0)
    place = layout.centroid[layout.members["affine"]] + affine.q[:, :3]
    momentum += np.cross(place, model.masses["affine"][:, :3] * affine.v[:, :3]).sum(axis=0)
    second = model.masses["affine"][:, 3:6]
    first = np.einsum("bij,bkj,bj->bik", affine.frame, affine.v[:, 3:].reshape(-1, 3, 3), second)
    return momentum + np.array([first[:, j, k] - first[:, k, j] for j, k in ((1, 2), (2, 0), (0, 1))]).sum(axis=1)


def carried(model) -> np.ndarray:
    """(3,) kg m: the sum of mass times place."""
    moved = ((kind, getattr(model.bodies, kind).q[:, :3]) for kind in ("rigid", "affine"))
    return sum(
        (model.masses[kind][:, 0] @ (model.layout.centroid[model.layout.members[kind]] + q)) for kind, q in moved
    )


def test_a_pair_that_meets_keeps_its_angular_momentum():
    model = assemble(flying()).model
    wanted, pressed, fall = angular_momentum(model), 0.0, np.array([0.0, 0.0, -G])
    spun = np.linalg.norm(model.bodies.rigid.momentum)
    for _ in range(400):
        advanced(model, 1)
        wanted = wanted + model.dt * np.cross(carried(model), fall)
        pressed = max(pressed, np.abs(model.bodies.affine.patches[:, :3]).max())
    assert pressed > 1e3, "they have met"
    assert angular_momentum(model) == pytest.approx(wanted, rel=0, abs=1e-12 * spun)


def test_what_a_hit_puts_into_a_soft_block_is_accounted_for_and_what_is_not_falls_with_the_step():
    left = []
    for fraction in (0.8, 0.4):
        rows = laboratory.run(flying(fraction)).history.rows
        known = sum(rows[key] for key in ("elastic_contacts", "friction", "dashpot", "redetection", "area"))
        assert rows["elastic_blocks"].max() > 0.05 * rows["kinetic"][0]
        assert np.abs(rows["imbalance"]).max() < 1e-12 * rows["kinetic"][0]
        assert np.abs(rows["rotor"]).max() < 1e-5 * rows["kinetic"][0]
        left.append(np.abs(rows["contact_work"] - known).max() / rows["kinetic"][0])
    assert left[0] < 1e-3
    assert left[1] < 0.5 * left[0]


def test_a_run_that_goes_on_from_what_was_kept_has_the_bits_of_a_whole_one():
    model, other = (assemble(flying()).model for _ in range(2))
    advanced(model, 170)
    kept = model_state.state(model)
    assert kept["motion.push"].any(), "the two blocks press just then"
    advanced(model, 100)
    model_state.restore(other, kept)
    advanced(other, 100)
    state = model_state.state(other)
    assert all(array.tobytes() == state[name].tobytes() for name, array in model_state.state(model).items())


def test_no_corner_moves_farther_than_the_travel_that_is_counted():
    model = assemble(flying()).model
    rng = np.random.default_rng(5)
    model.bodies.affine.v[:, 3:] = 20.0 * rng.normal(size=(2, 9))
    motion, pieces = model.large.near.motion, model.large.near.pieces
    advanced(model, 1)
    travel, before = motion.travel.copy(), corners(model)
    share = []
    for _ in range(50):
        advanced(model, 1)
        moved = np.linalg.norm(corners(model) - before, axis=1)
        most = np.array([moved[pieces.vertex_start[p] : pieces.vertex_start[p + 1]].max() for p in range(3)])
        share.append(most / (motion.travel - travel))
    assert np.max(share) <= 1.0
    assert np.max(share) > 0.5, "a bound that is twice the motion looks at contacts too often"


def corners(model) -> np.ndarray:
    """(V, 3) m, where the corners of all blocks are."""
    motion, pieces = model.large.near.motion, model.large.near.pieces
    body = np.repeat(pieces.body, np.diff(pieces.vertex_start))
    return (motion.centre + motion.moved)[body] + np.einsum("vij,vj->vi", motion.frame[body], pieces.vertex)


def test_a_block_that_is_squeezed_or_stretched_too_far_is_told():
    look = LargestDeformation(1.02)
    for least, longest in ((0.99, 1.01), (0.75, 1.01), (0.9, 1.3)):
        look.look(None, View(None, least=least, longest=longest), 0)
    squeezed, stretched = (doubt.sentence for doubt in of_strains(look.records()[0]))
    assert squeezed.startswith("blocks are squeezed to 0.75 of their volume: below 0.8")
    assert stretched.startswith("blocks are stretched by 1.3, more than the 1.02")
    calm = LargestDeformation(1.02)
    calm.look(None, View(None, least=0.99, longest=1.01), 0)
    assert of_strains(calm.records()[0]) == []
