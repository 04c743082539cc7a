"""Gauges against beam theory, and against the displacements that a run keeps of corners and nodes."""

from functools import cache

import numpy as np
import pytest

from masonry import scene
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from tests.large.made import dry, slab
from tests.model.test_bending import ARM, BEAM, HEIGHT, INSET, LENGTH, NORMAL, ROLLER, SHEAR, SPAN, STRIP, THICKNESS
from tests.scenes import box, load

DEFLECTION = """
[[gauge]]
name = "deflection"
at = {x = "middle", y = "120 mm"}
direction = "y"
relative_to = "support rollers"
[[gauge]]
name = "load rollers"
at = "load rollers"
direction = "-y"
"""


@cache
def bent() -> Result:
    return laboratory.run(load((BEAM + DEFLECTION).replace("plates = ", "# plates = ")))


def test_mid_span_of_a_beam_on_two_rollers_goes_down_as_beam_theory_says():
    """By the unit load 1 at mid-span: sum of M m/(kn I) + V v/(ks A) over the joints, and R r/(k A) at the supports."""
    rows = bent().history.rows
    place = np.minimum(np.arange(1, 9) * 0.1, LENGTH - np.arange(1, 9) * 0.1) - INSET
    moment, unit = np.minimum(place, ARM) / 2, np.minimum(place, SPAN / 2) / 2
    bending = np.sum(moment * unit) / (NORMAL * HEIGHT * THICKNESS**3 / 12)
    shear = np.sum(place < ARM) / 4 / (SHEAR * HEIGHT * THICKNESS)
    pressed = 2 / 4 / (STRIP * ROLLER * HEIGHT)
    assert rows["deflection"][-1] == pytest.approx(rows["force"][-1] * (bending + shear + pressed), rel=1e-3)
    assert rows["deflection"][0] == 0.0


def test_a_gauge_on_what_is_driven_reads_the_drive_with_the_sign_of_its_direction():
    rows = bent().history.rows
    assert np.allclose(rows["load rollers"], -rows["displacement"], rtol=1e-9, atol=0)


def test_the_force_is_the_stress_times_the_section():
    result = bent()
    assert np.allclose(result.history.rows["force"], result.history.rows["stress"] * result.specimen.section)
    assert result.summary["peak_force_n"] == pytest.approx(result.history.rows["force"].max(), rel=1e-6)


def test_the_summary_tells_each_gauge_at_the_peak_and_at_the_end():
    result = bent()
    readings = result.summary["gauges"]["deflection"]
    assert readings["final_m"] == result.history.rows["deflection"][-1]
    assert 0.0 < readings["at_peak_m"] <= readings["final_m"] * (1 + 1e-9)


GAUGES = """
[[gauge]]
name = "corner"
at = {x = "200 mm", y = "0 mm", z = "100 mm"}
direction = "z"
[[gauge]]
name = "face"
at = "top.x+"
direction = "x"
[[gauge]]
name = "edge"
at = {y = "50 mm", z = "0 mm"}
direction = "y"
[[gauge]]
name = "whole"
at = "top"
direction = "z"
relative_to = "bottom"
"""


@cache
def couplet(kinematics: str) -> Result:
    """A couplet that is pulled apart aslant, so that it turns, strains and, with tets, bends."""
    text = """
law = "elastic"
[specimen]
kind = "couplet"
length = "200 mm"
width = "50 mm"
height = "50 mm"
mesh_size = "40 mm"
[material.units]
density = "1900 kg/m^3"
young_modulus = "1 GPa"
poisson_ratio = 0.2
[contact.unit_unit]
normal_stiffness = "50 GPa/m"
shear_stiffness = "20 GPa/m"
[[support]]
on = "bottom"
fix = "all"
[[traction]]
on = "top.x+"
stress = {x = "0.3 MPa", y = "0.2 MPa", z = "0.5 MPa"}
[settle]
steps = 300
"""
    return laboratory.run(load(text + GAUGES, kinematics=kinematics))


def ends(kinematics: str):
    """The last readings; places and displacements of all corners (of all nodes with tets) in the last frame."""
    result = couplet(kinematics)
    frame, mesh = result.history.frames[-1], result.mesh
    places, moved = (result.specimen.blocks.points, frame.corners) if mesh is None else (mesh.nodes, frame.nodes)
    return {name: result.history.rows[name][-1] for name in ("corner", "face", "edge", "whole")}, places, moved


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_a_gauge_at_a_corner_reads_the_displacement_of_that_corner(kinematics):
    reading, places, moved = ends(kinematics)
    at = np.flatnonzero(np.abs(places - (0.2, 0.0, 0.1)).max(axis=1) < 1e-9)
    assert np.all(moved[at, 2] != 0.0)
    assert reading["corner"] == pytest.approx(moved[at, 2].mean(), rel=1e-12)


@pytest.mark.parametrize("kinematics", ["rigid", "affine"])
def test_a_gauge_on_a_face_or_a_set_reads_the_mean_of_its_corners(kinematics):
    reading, places, moved = ends(kinematics)
    face = np.isclose(places[:, 0], 0.2) & (np.arange(len(places)) >= 8)
    assert reading["face"] == pytest.approx(moved[face, 0].mean(), rel=1e-12)
    assert reading["whole"] == pytest.approx(moved[8:, 2].mean(), rel=1e-12)


def test_gauges_in_tets_take_the_mean_over_a_line_a_face_and_a_volume():
    """The trapezoid rule over the nodes of the edge; faces and volumes by integrals over tets, written apart."""
    reading, places, moved = ends("tets")
    mesh = couplet("tets").mesh
    edge = np.flatnonzero(np.isclose(places[:, 1], 0.05) & np.isclose(places[:, 2], 0.0))
    edge = edge[np.argsort(places[edge, 0])]
    assert reading["edge"] == pytest.approx(np.trapezoid(moved[edge, 1], places[edge, 0]) / 0.2, abs=1e-15)
    corner = mesh.nodes[mesh.tets]
    volume = np.abs(np.linalg.det(corner[:, 1:] - corner[:, :1])) / 6
    upper = corner[:, :, 2].mean(axis=1) > 0.05
    mean = np.average(moved[mesh.tets][upper].mean(axis=1)[:, 2], weights=volume[upper])
    assert reading["whole"] == pytest.approx(mean, rel=1e-12)
    on = np.isclose(corner[:, :, 0], 0.2) & upper[:, None]
    triangle = mesh.tets[on.sum(axis=1) == 3][on[on.sum(axis=1) == 3]].reshape(-1, 3)
    a, b, c = (mesh.nodes[triangle[:, k]] for k in range(3))
    mean = np.average(moved[triangle].mean(axis=1)[:, 0], weights=np.linalg.norm(np.cross(b - a, c - a), axis=1))
    assert reading["face"] == pytest.approx(mean, rel=1e-12)


def test_a_scene_without_gauges_has_no_more_columns_and_the_same_numbers():
    plain = {"drive.steps": 200, "settle.steps": 100, "solver.rows": 10}
    rows = laboratory.run(scene.load("couplet", plain)).history.rows
    assert "deflection" not in rows and "force" in rows
    gauged = {**plain, "gauge": [{"name": "top", "at": "top", "direction": "x"}]}
    again = laboratory.run(scene.load("couplet", gauged)).history.rows
    assert set(again) - set(rows) == {"top"}
    assert all(np.array_equal(rows[name], again[name]) for name in rows)


def test_gauges_follow_the_points_of_a_block_that_turns_by_a_right_angle():
    spin, corner = '[[motion]]\non = "brick"\nspin = [0, 0, "5 rad/s"]\n', {"x": 0.1, "y": 0.05, "z": 1.03}
    at = ", ".join(f'{axis} = "{value} m"' for axis, value in corner.items())
    places = {"x of corner": (f"{{{at}}}", "x"), "y of corner": (f"{{{at}}}", "y"), "y of face": ('"brick.x+"', "y")}
    gauges = "".join(f'[[gauge]]\nname = "{n}"\nat = {a}\ndirection = "{d}"\n' for n, (a, d) in places.items())
    brick = box("brick", (-0.1, -0.05, 1.0), (0.2, 0.1, 0.06), "units", 1)
    rows = laboratory.run(dry([slab(2.0), brick], duration=0.1 * np.pi, more=spin + gauges)).history.rows
    found = [rows[name][-1] for name in places]
    assert found == pytest.approx([-0.05 - 0.1, 0.1 - 0.05, 0.1], abs=1e-4 * 0.2)
