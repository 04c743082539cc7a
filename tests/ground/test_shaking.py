"""Blocks on ground that moves: forces of inertia and a base that moves are one motion."""

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.scene import load
from tests import scenes

SCENE = """
law = "{law}"
displacements = "{displacements}"
kinematics = {{default = "{kinematics}", base = "rigid"}}
{specimen}
[material.units]
density = "2000 kg/m^3"
young_modulus = "1 GPa"
poisson_ratio = 0.2
[material.base]
density = "2000 kg/m^3"
[contact.base_units]
normal_stiffness = "1 GPa/m"
shear_stiffness = "1 GPa/m"
{joint}
[[support]]
on = "base"
fix = "all"
[gravity]
z = "-9.81 m/s^2"
[settle]
steps = 3000
[ground]
x = "0.5 g * sin(2 pi t / 0.2 s)"
y = "0.1 g * sin(2 pi t / 0.1 s)"
duration = "0.2 s"
[solver]
damping = 0
[[gauge]]
name = "u"
at = "block"
direction = "x"
relative_to = "base"
[[gauge]]
name = "v"
at = "block"
direction = "y"
relative_to = "base"
"""
DRY, GLUED = "tan_friction_angle = 0.2", "tensile_strength = '5 MPa'\ncohesion = '5 MPa'\ntan_friction_angle = 0.5"


def scene(tmp_path, displacements="small", kinematics="rigid", law="friction", x=-1, **keys):
    joint = DRY if law == "friction" else GLUED
    boxes = [
        scenes.box("base", (x, -1, -0.5), (3, 2, 0.5), "base", 0),
        scenes.box("block", (x + 1, -0.25, 0), (1, 0.5, 0.2), "units", 1),
    ]
    specimen = scenes.specimen(boxes, 1.0, more='mesh = "fan"')
    text = SCENE.format(displacements=displacements, kinematics=kinematics, law=law, joint=joint, specimen=specimen)
    (tmp_path / "shaken.toml").write_text(text)
    return load(tmp_path / "shaken.toml", keys)


def curves(result):
    return np.array([result.curve["u"], result.curve["v"]])


@pytest.mark.parametrize(
    ("displacements", "kinematics", "law", "x"),
    [
        ("small", "rigid", "friction", -1),
        ("small", "affine", "elastic", -1),
        ("large", "rigid", "friction", -1),
        ("large", "rigid", "friction", 10_000),
    ],
)
def test_a_base_that_moves_and_forces_of_inertia_are_the_same_relative_motion(
    tmp_path, displacements, kinematics, law, x
):
    shaken = scene(tmp_path, displacements, kinematics, law, x)
    inertia, base = (masonry.run(shaken.with_({"ground.as": word})) for word in ("inertia", "base"))
    away = np.abs(curves(inertia) - curves(base)).max()
    limit = 1e-6 if displacements == "large" else 1e-8  # faces that slide and turn are looked at at other steps
    assert away < limit * np.abs(curves(inertia)).max()
    for result in (inertia, base):
        work = np.abs(result.curve["external_work"]).max()
        assert np.abs(result.curve["imbalance"]).max() < 1e-11 * work


def test_a_block_rocks_alike_in_both_frames_where_it_is_looked_at_as_often():
    """Its dead load settles as long as it needs; supports that move rest meanwhile."""
    away = {"name": "sway", "at": "block.z+", "direction": "x", "relative_to": "floor"}
    keys = {"ground.peak": "0.4 g", "solver.duration": "3 s", "gauge": [away]}
    inertia, base = (masonry.run(load("block-shaken", keys | {"ground.as": word})) for word in ("inertia", "base"))
    sway = inertia.curve["sway"]
    assert len(sway) == len(base.curve["sway"]) and np.abs(sway).max() > 3e-3, "it has left the ground"
    assert np.abs(sway - base.curve["sway"]).max() < 1e-8 * np.abs(sway).max()


def test_the_force_of_inertia_is_the_mean_acceleration_over_each_step(tmp_path):
    assembly = assemble(scene(tmp_path))
    plan, dt = assembly.plan, assembly.model.dt
    loading = plan.loading(assembly.model, 100)
    mass = 2000 * 0.1
    forces = []
    while (chunk := loading.next()) is not None:
        body = assembly.model.bodies.rigid
        share = np.maximum(chunk.dead_load - 1.0, 0.0)[:, None]
        forces.append((body.load[1, :2] + share * body.change[1, :2])[1:])
    force = np.concatenate(forces)[plan.settle :]
    for axis, motion in enumerate(assembly.scene.shaken.motions.values()):
        gained = np.diff(motion.velocity_at(dt * np.arange(plan.steps - plan.settle + 1)))
        assert force[:, axis] == pytest.approx(-mass * gained / dt, abs=1e-9 * mass)


def test_ground_begins_when_it_is_told_to_and_rests_afterwards(tmp_path):
    later = scene(tmp_path, **{"ground.begin": "0.1 s", "solver.duration": "0.5 s"})
    result = masonry.run(later)
    time = np.array(result.curve["time"]) - 3000 * assemble(later).model.dt
    slip = np.array(result.curve["u"])
    assert np.abs(slip[time < 0.1]).max() < 1e-9 and time[-1] == pytest.approx(0.5, abs=1e-3)
    assert np.ptp(slip[time > 0.45]) < 1e-2 * np.abs(slip[-1])


def test_a_base_follows_its_record_and_its_work_is_in_the_ledger(tmp_path):
    result = masonry.run(scene(tmp_path, "small", "affine", "elastic", **{"ground.as": "base"}))
    terms = {name: float(result.curve[name].iloc[-1]) for name in ("external_work", "kinetic", "elastic_contacts")}
    assert abs(terms["external_work"]) > 0.0 and abs(result.curve["imbalance"].iloc[-1]) < 1e-12


def test_supports_that_move_apart_stretch_what_stands_between_them(tmp_path):
    """A bar between two plates: one rests, the other goes away by 0.1 mm, and the bar is pulled."""
    boxes = [scenes.box(name, (k, 0, 0), (1, 1, 1), f"{name}s", k) for k, name in enumerate(("near", "bar", "far"))]
    text = 'law = "elastic"\n' + scenes.specimen(boxes, 1.0)
    text += "".join(f'[material.{name}s]\ndensity = "2000 kg/m^3"\n' for name in ("near", "bar", "far"))
    stiff = '[contact.{}]\nnormal_stiffness = "1 GPa/m"\nshear_stiffness = "1 GPa/m"\n'
    text += stiff.format("bars_nears") + stiff.format("bars_fars")
    text += "".join(f'[[support]]\non = "{name}"\nfix = "all"\n' for name in ("near", "far"))
    text += '[[ground]]\non = "far"\nas = "base"\nquantity = "displacement"\n'
    text += 'x = "0.05 mm * (1 - cos(2 pi t / 1 s))"\nduration = "0.5 s"\n'
    text += "".join(f'[[gauge]]\nname = "{name}"\nat = "{name}"\ndirection = "x"\n' for name in ("bar", "far"))
    (tmp_path / "apart.toml").write_text(text + "[solver]\ndamping = 0.5\n")
    result = masonry.run(load(tmp_path / "apart.toml"))
    assert float(result.curve["far"].iloc[-1]) == pytest.approx(1e-4, rel=1e-4)
    assert float(result.curve["bar"].iloc[-1]) == pytest.approx(5e-5, rel=1e-3)


@pytest.mark.parametrize("displacements", ["small", "large"])
@pytest.mark.parametrize("moved", [("far",), ("far", "near")])
def test_supports_that_move_towards_each_other_press_each_other(displacements, moved):
    """kn times the way between them, though nothing here is free; one of them rests, or each has its own motion."""
    boxes = [scenes.box(name, (k, 0, 0), (1, 1, 1), f"{name}s", k) for k, name in enumerate(("near", "far"))]
    text = f'displacements = "{displacements}"\nlaw = "friction"\n' + scenes.specimen(boxes, 1.0)
    text += "".join(f'[material.{name}s]\ndensity = "2000 kg/m^3"\n' for name in ("near", "far"))
    text += (
        '[contact.fars_nears]\nnormal_stiffness = "1 GPa/m"\nshear_stiffness = "1 GPa/m"\ntan_friction_angle = 0.6\n'
    )
    text += "".join(f'[[support]]\non = "{name}"\nfix = "all"\n' for name in ("near", "far"))
    for name in moved:
        way = "0.05 mm" if name == "near" else "-0.05 mm"
        text += f'[[ground]]\non = "{name}"\nas = "base"\nquantity = "displacement"\nduration = "0.5 s"\n'
        text += f'x = "{way} * (1 - cos(2 pi t / 1 s))"\n'
    result = masonry.run(scenes.load(text + '[solver]\ntime_step = "1e-4 s"\nrows = 20\n'))
    presses = result.summary["reactions"]["end"]["support.0"]["force_n"]
    assert presses == pytest.approx([1e9 * 1e-4 * len(moved), 0.0, 0.0], rel=1e-6)


def test_a_floor_reaches_as_far_as_the_ground_moves_unless_it_has_a_size():
    away = {"ground.x": "0.5 g * sin(2 pi t / 2 s)", "ground.made": None, "ground.duration": "2 s", "ground.peak": None}
    for floor, duration, reach in (
        ({}, "3 s", 2.0 + 0.5 * 9.80665 * 2.0 / np.pi),
        ({"size": ["3 m", "3 m"]}, "3 s", 1.375),
    ):
        shaken = load("block-shaken", {**away, "floor": floor, "solver.duration": duration})
        blocks = assemble(shaken).specimen.blocks
        points = blocks.points[blocks.face_points][:, 0]
        assert points.max() - 0.125 == pytest.approx(reach, rel=1e-4)
