"""Meshed blocks among rigid and affine ones in large displacement: their patches lie between points of the meshes."""

from functools import cache
from math import cos, radians, sin

import numpy as np
import pytest

from masonry import scene as packaged
from masonry.assembly.assemble import assemble
from masonry.configuration import energy, model_state
from masonry.detection.tet_pieces import FACES
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.model.large.block_motion import outer_tets
from masonry.patches.refreshing import refresh
from tests.kinematics.bricks import turn
from tests.large.by_hand.patch_calls import press_deforming, stored_energy
from tests.large.made import DENSITY, G, gather, hand_over, leaning, slab
from tests.large.test_deforming import advanced
from tests.scenes import box, listed, load, specimen, tables
from verification.fixtures.dry_blocks import restitution

SLOPE = 25.0
KINDS = '{default = "rigid", bricks = "affine", meshed = "tets"}'
GAUGES = "".join(f'[[gauge]]\nname = "{axis}"\nat = "block"\ndirection = "{axis}"\n' for axis in "xyz")
KN = 10e9


def scene(boxes, gravity, duration, young="1 GPa", turned="", more="", held=True, zeta=0.0, mesh='mesh = "fan"'):
    """Rigid `units`, affine `bricks` and `meshed` blocks: all of this file is one compiled kind."""
    down = "\n".join(f'{axis} = "{part!r} m/s^2"' for axis, part in zip("xyz", map(float, gravity), strict=True))
    contact = 'normal_stiffness = "10 GPa/m"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = 0.3'
    contact += f"\nnormal_dashpot = {zeta}" if zeta else ""
    material = f'density = "{DENSITY} kg/m^3"\nyoung_modulus = "{young}"\npoisson_ratio = 0.2'
    return load(
        f'displacements = "large"\nlaw = "friction"\nkinematics = {KINDS}\n'
        + specimen(boxes, 0.01, mesh_size="50 mm", more=f"{mesh}\n{turned}")
        + tables("material", dict.fromkeys(("units", "bricks", "meshed"), material))
        + tables("contact", {"default": contact})
        + listed("support", ['on = "slab"\nfix = "all"'] if held else [])
        + f"[gravity]\n{down}\n[settle]\nsteps = 0\n"
        + f'[solver]\nmasses = "real"\ndamping = 0\nduration = "{duration} s"\nrows = 100\n{more}'
    )


def on_a_slope(gravity, duration=0.1, **settings):
    """A meshed block with an affine one on it, on a rigid slab."""
    boxes = [
        slab(1.0),
        box("block", (-0.125, -0.125, 0.0), (0.25, 0.25, 0.125), "meshed", 1),
        box("top", (-0.125, -0.125, 0.125), (0.125, 0.125, 0.0625), "bricks", 2),
    ]
    return scene(boxes, gravity, duration, **settings)


@cache
def sliding():
    return laboratory.run(on_a_slope(leaning(SLOPE), more=GAUGES))


def test_a_meshed_block_slides_with_the_share_of_gravity_that_friction_leaves():
    rows, lean = sliding().history.rows, radians(SLOPE)
    pace = G * (sin(lean) - 0.3 * cos(lean))
    wanted = 0.5 * pace * rows["time"] ** 2
    assert rows["x"] == pytest.approx(wanted, abs=0.02 * wanted[-1])
    weight = DENSITY * (0.25 * 0.25 * 0.125 + 0.125 * 0.125 * 0.0625) * G
    assert rows["friction"][-1] == pytest.approx(0.3 * weight * cos(lean) * rows["x"][-1], rel=0.02)


def test_the_ledger_closes_and_forces_add_up_while_it_slides():
    rows, summary = sliding().history.rows, sliding().summary
    assert np.abs(rows["imbalance"]).max() < 1e-12 * np.abs(rows["external_work"]).max()
    assert summary["dissipation_mismatch"] < 1e-4
    assert summary["force_balance"] < 1e-9
    assert summary["kinematics"] == "affine + rigid + tets"
    assert summary["rotation_max_rad"] < 1e-3
    frame = sliding().history.frames[-1]
    assert np.abs(frame.nodes[:, 0] - rows["x"][-1]).max() < 1e-4, "frames show where the nodes are"
    assert np.abs(frame.corners[8:16, 0] - rows["x"][-1]).max() < 1e-4


def test_the_scene_may_be_turned_by_a_right_angle():
    x, y, z = leaning(SLOPE)
    more = f'time_step = "5e-6 s"\n{GAUGES}'
    one = laboratory.run(on_a_slope((x, y, z), 0.02, more=more)).history.rows
    turned = 'turned = {about = "z", angle = "90 deg"}'
    other = laboratory.run(on_a_slope((-y, x, z), 0.02, turned=turned, more=more)).history.rows
    early = one["time"] < 0.01
    for key, rows in (("kinetic", slice(None)), ("friction", slice(None)), ("elastic_blocks", early)):
        assert other[key][rows] == pytest.approx(one[key][rows], rel=0, abs=1e-9 * np.abs(one[key]).max()), key
    assert other["y"] == pytest.approx(one["x"], rel=0, abs=1e-9 * np.abs(one["x"]).max())


def flying():
    """A rigid block and a soft meshed one that fly at each other, askew and spinning, an affine one on the first."""
    boxes = [
        box("slab", (0.0, 0.0, 0.0), (0.2, 0.1, 0.1), "units", 0),
        box("block", (0.204, 0.03, 0.02), (0.1, 0.15, 0.12), "meshed", 1),
        box("rider", (0.05, 0.0, 0.1), (0.1, 0.1, 0.05), "bricks", 2),
    ]
    motion = (
        '[[motion]]\non = "slab"\nvelocity = ["2 m/s", 0, "0.2 m/s"]\nspin = ["1 rad/s", "3 rad/s", "2 rad/s"]\n'
        '[[motion]]\non = "block"\nvelocity = ["-1 m/s", "0.3 m/s", 0]\n'
    )
    return scene(boxes, (0.0, 0.0, -G), 0.02, "0.5 GPa", more=motion, held=False)


def places(model, kind: str) -> np.ndarray:
    """(rows, 3) m, of centroids or nodes."""
    if kind == "tets":
        return model.layout.mesh.nodes + model.u[: len(model.layout.mesh.nodes)]
    return model.layout.centroid[model.layout.members[kind]] + getattr(model.bodies, kind).q[:, :3]


def angular_momentum(model) -> np.ndarray:
    """(3,) kg m2/s about the origin, of velocities half a step after the places."""
    momentum = model.bodies.rigid.momentum.sum(axis=0)
    for kind, body in energy.present(model):
        momentum = momentum + np.cross(places(model, kind), model.masses[kind][:, :3] * body.v[:, :3]).sum(axis=0)
    affine, second = model.bodies.affine, model.masses["affine"][:, 3:6]
    first = np.einsum("bij,bkj,bj->bik", affine.frame, affine.v[:, 3:].reshape(-1, 3, 3), second)
    return momentum + np.array([first[:, j, k] - first[:, k, j] for j, k in ((1, 2), (2, 0), (0, 1))]).sum(axis=1)


def test_blocks_that_meet_keep_their_angular_momentum():
    model = assemble(flying()).model
    wanted, pressed, fall = angular_momentum(model), 0.0, np.array([0.0, 0.0, -G])
    spun = np.linalg.norm(model.bodies.rigid.momentum)
    for _ in range(400):
        advanced(model, 1)
        carried = sum(model.masses[kind][:, 0] @ places(model, kind) for kind, _ in energy.present(model))
        wanted = wanted + model.dt * np.cross(carried, fall)
        pressed = max(pressed, np.abs(model.bodies.tets.patches).max())
    assert pressed > 100.0, "they have met"
    assert angular_momentum(model) == pytest.approx(wanted, rel=0, abs=1e-12 * spun)


def test_what_a_hit_puts_into_a_meshed_block_is_accounted_for():
    rows = laboratory.run(flying()).history.rows
    known = sum(rows[key] for key in ("elastic_contacts", "friction", "dashpot", "redetection", "area"))
    assert rows["elastic_blocks"].max() > 0.05 * rows["kinetic"][0]
    assert np.abs(rows["imbalance"]).max() < 1e-12 * rows["kinetic"][0]
    assert rows["contact_work"] == pytest.approx(known, rel=0, abs=1e-3 * rows["kinetic"][0])


def test_a_run_that_goes_on_from_what_was_kept_has_the_bits_of_a_whole_one():
    model, other = (assemble(flying()).model for _ in range(2))
    while not model.bodies.tets.patches.any():
        advanced(model, 5)
    kept = model_state.state(model)
    advanced(model, 100)
    model_state.restore(other, kept)
    advanced(other, 100)
    state = model_state.state(other)
    assert all(array.tobytes() == state[name].tobytes() for name, array in model_state.state(model).items())


def test_an_even_pressure_gives_every_node_its_share_of_the_area_whatever_the_two_meshes():
    """A patch test: overlaps of triangles of two meshes, lumped at their corners, are exact for what is linear."""
    boxes = [
        slab(1.0),
        box("block", (-0.125, -0.125, 0.0), (0.25, 0.25, 0.125), "meshed", 1),
        box("other", (-0.125, -0.125, 0.125), (0.2, 0.23, 0.1), "meshed", 2),
        box("top", (-0.125, -0.125, 0.225), (0.125, 0.125, 0.0625), "bricks", 3),
    ]
    model = assemble(scene(boxes, leaning(SLOPE), 0.1)).model
    tets, mesh, deep = model.bodies.tets, model.layout.mesh, 1e-5
    for _, body in energy.present(model):
        body.v[...] = 0.0
    upper = mesh.nodes[:, 2] > 0.125
    upper[mesh.node_start[2] : mesh.node_start[3]] = True
    model.u[: len(upper)][upper] = 0.013, 0.007, -deep
    model.bodies.affine.q[:, 2] = 1e-3
    gather(model)
    large = model.large
    assert refresh(large.near) >= 0.0
    press_deforming(large.near, 0.0)
    hand_over(model)
    force, own = tets.patches, mesh.nodes[:, 2] == 0.125
    for which, sign in ((own & ~upper, -1.0), (own & upper, 1.0)):
        pushed = force[which]
        assert pushed[:, 2].sum() == pytest.approx(sign * KN * deep * 0.2 * 0.23, rel=1e-9)
        assert (pushed[:, 2] * sign >= 0.0).all()
        centre = (0.5 * 0.2 - 0.125 + 0.013, 0.5 * 0.23 - 0.125 + 0.007, 0.0)
        moment = np.cross(mesh.nodes[which] + model.u[: len(upper)][which] - centre, pushed).sum(axis=0)
        assert moment == pytest.approx(np.zeros(3), abs=1e-9 * KN * deep * 0.2 * 0.23)
    shares = node_areas(model, own & upper)
    assert force[own & upper, 2] == pytest.approx(KN * deep * shares, rel=1e-9)
    assert stored_energy(large.near) == pytest.approx(0.5 * KN * deep**2 * 0.2 * 0.23, rel=1e-9)


def node_areas(model, which: np.ndarray) -> np.ndarray:
    """(n,) m2, a third of all triangles of the surface whose corners are among some nodes."""
    area, tets = np.zeros(len(which)), outer_tets(model.layout)
    for node, outer in zip(tets.node, tets.outer, strict=True):
        for face in np.array(FACES)[outer]:
            corner = node[face]
            if which[corner].all():
                a, b, c = model.layout.mesh.nodes[corner]
                area[corner] += np.linalg.norm(np.cross(b - a, c - a)) / 6.0
    return area[which]


def test_the_forces_on_nodes_are_the_derivatives_of_the_energy_that_is_stored():
    model = assemble(on_a_slope(leaning(SLOPE))).model
    for _, body in energy.present(model):
        body.v[...] = 0.0
    rng, count = np.random.default_rng(3), len(model.layout.mesh.nodes)
    turned = turn(0, 2e-4) @ turn(1, 1e-4)
    nodes = model.layout.mesh.nodes
    model.u[:count] = nodes @ (turned - np.eye(3)).T + 1e-6 * rng.normal(size=(count, 3)) - [0.0, 0.0, 1e-5]
    gather(model)
    large = model.large
    assert refresh(large.near) >= 0.0
    press_deforming(large.near, 0.0)
    hand_over(model)
    force, size = model.bodies.tets.patches.copy(), np.abs(model.bodies.tets.patches).max()
    assert size > 10.0
    for n in np.flatnonzero(np.abs(force).max(axis=1) > 0.0):
        for i in range(3):
            ends = []
            for step in (1e-8, -1e-8):
                model.u[n, i] += step
                gather(model)
                ends.append(stored_energy(large.near))
                model.u[n, i] -= step
            assert (ends[0] - ends[1]) / 2e-8 == pytest.approx(-force[n, i], rel=0, abs=1e-5 * size)


EDGE, SLAB = 0.1, (0.5, 0.5, 0.05)


def hit(zeta: float, mesh='mesh = "fan"', young="100 GPa", more="", twins=False):
    """A meshed cube that flies at a held slab, or at a cube like itself, without weight; an affine block far away."""
    other = box("slab", (0.0, 0.0, -SLAB[2]), SLAB, "units", 0)
    if twins:
        other = box("other", (0.2, 0.2, -EDGE), (EDGE,) * 3, "meshed", 0)
    away = [box("away", (2.0, 0.0, 0.0), (0.1, 0.1, 0.1), "bricks", 2)]
    away += [box("slab", (4.0, 0.0, 0.0), (0.1, 0.1, 0.1), "units", 3)] if twins else []
    boxes = [other, box("block", (0.2, 0.2, 1e-4), (EDGE,) * 3, "meshed", 1), *away]
    flies = '[[motion]]\non = "block"\nvelocity = [0, 0, "-1 m/s"]\n'
    return scene(boxes, np.zeros(3), 1e-3, young, more=more + "\n" + flies, zeta=zeta, mesh=mesh)


@pytest.mark.parametrize("mesh", ['mesh = "fan"', ""])
@pytest.mark.parametrize("zeta", [0.1, 0.4])
def test_a_stiff_cube_bounces_as_a_rigid_one_whatever_its_mesh(zeta, mesh):
    """The mass behind a face of the cube meets a slab that is held, whose own mass does not count."""
    rows = laboratory.run(hit(zeta, mesh, "400 GPa", "step_fraction = 0.3")).history.rows
    assert np.abs(rows["imbalance"]).max() < 1e-11 * rows["kinetic"][0]
    kept = np.sqrt(rows["kinetic"][-1] / rows["kinetic"][0])
    assert kept == pytest.approx(restitution(zeta), rel=0.006)


def let_go(lean: int, kinematics: str) -> float:
    """Energy of motion of a slender block 0.1 s after it was let go on its edge, turned by a lean (deg)."""
    keys = {f"material.units.{key}": value for key, value in (("young_modulus", "50 GPa"), ("poisson_ratio", 0.2))}
    chosen = {"kinematics": kinematics, "specimen.mesh_size": "0.2 m", "specimen.turned.angle": f"{lean} deg"}
    scene = packaged.load("block-rocking", keys | chosen | {"solver.duration": "0.1 s"})
    return float(laboratory.run(scene).history.rows["kinetic"][-1])


@pytest.mark.parametrize("lean", [7, 30, 80])
def test_a_stiff_meshed_block_on_its_edge_turns_about_it_as_a_rigid_one(lean):
    assert let_go(lean, "tets") == pytest.approx(let_go(lean, "rigid"), rel=0.05)


@pytest.mark.parametrize("zeta", [0.3, 1.0])
def test_the_proven_step_is_stable_with_dashpots_of_a_soft_mesh(zeta):
    rows = laboratory.run(hit(zeta, "", "1 GPa", "step_fraction = 0.99", twins=True)).history.rows
    energies = np.sum([rows[key] for key in ("kinetic", "elastic_blocks", "elastic_contacts")], axis=0)
    assert np.all(np.diff(energies) < 1e-6 * rows["kinetic"][0])
    assert rows["dashpot"][-1] > 0.1 * rows["kinetic"][0]


def test_dashpots_of_meshed_blocks_with_scaled_masses_are_refused_in_one_sentence():
    dashpot = {"displacements": "large", "kinematics": "tets", "contact.unit_unit.normal_dashpot": 0.5}
    with pytest.raises(SceneError, match='^normal_dashpot of blocks of kinematics .* needs solver.masses = "real"'):
        laboratory.run(packaged.load("couplet", dashpot))
