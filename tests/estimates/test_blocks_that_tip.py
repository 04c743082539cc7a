"""Dry blocks that tip under their weight sideways: by few points they bear too little or too much, and say so."""

import pytest

from masonry.judgement.judgement import judgement_of
from masonry.laboratory import laboratory
from masonry.scene import load as packaged
from tests.convergence.samples import TIPPED, borne
from tests.scenes import box, listed, load, specimen, tables

STRIPPED = {
    "cut-off": ('\ncrushing = "cut-off"\ncompressive_strength = "0.5 MPa"', 1.0 - 1962.0 * 9.81 / 0.5e6),
    "dry": ("", 1.0),
}
"""What a contact has besides; the share of its thickness over height that a block of 1 m bears, by a stress block."""
ROWS = [("vertex", 2), ("vertex", 3), ("vertex", 10), ("gauss", 2), ("gauss", 3), ("gauss", 10)]


@pytest.mark.parametrize(("rule", "along"), ROWS)
@pytest.mark.parametrize(("direction", "thickness"), [("x", 0.5), ("-y", 0.3)])
@pytest.mark.parametrize("stripped", STRIPPED)
def test_a_block_that_tips_says_by_how_much_its_points_are_off(stripped, direction, thickness, rule, along):
    more, share = STRIPPED[stripped]
    boxes = [
        box("g", (-0.5, -0.5, -0.2), (1.5, 1.3, 0.2), "units", 0),
        box("b", (0.0, 0.0, 0.0), (0.5, 0.3, 1.0), "units", 1),
    ]
    stiff = 'law = "friction"\nnormal_stiffness = "50 GPa/m"\nshear_stiffness = "20 GPa/m"\ntan_friction_angle = 2.0'
    scene = load(
        'kinematics = "rigid"\n'
        + specimen(boxes, 1.0, more=f'contact_points = "{rule}"\npoints_per_edge = {along}')
        + tables("material", {"units": 'density = "1962 kg/m^3"'})
        + tables("contact", {"unit_unit": stiff + more})
        + listed("support", ['on = "g"\nfix = "all"'])
        + '[gravity]\nz = "-9.81 m/s^2"\n'
        + f'[limit]\npattern = "weight"\ndirection = "{direction}"\naccuracy = "0.5 %"\n'
    )
    summary = laboratory.run(scene).summary
    off = summary["collapse_load"].borne / (thickness * share) - 1.0
    said = [doubt.value for doubt in judgement_of(summary).doubts if doubt.name == "few_points"]
    assert said == ([pytest.approx(off, abs=0.008)] if said else []) and (said or abs(off) < 0.0175)
    assert bool(said) or (along == 10) or (stripped, rule) == ("dry", "vertex")


@pytest.mark.parametrize(("rule", "along"), [("vertex", 2), ("vertex", 4), ("gauss", 3), ("gauss", 6)])
def test_a_block_that_a_drive_tips_a_little_stands_on_a_strip_that_few_points_do_not_have(rule, along):
    """Points at the edges bear at the edge; the strip has its resultant a third of its width within."""
    scene = packaged(TIPPED).with_({"specimen.contact_points": rule, "specimen.points_per_edge": along})
    summary = laboratory.run(scene).summary
    off = summary["final_stress_pa"] / borne() - 1.0
    (said,) = [doubt.value for doubt in judgement_of(summary).doubts if doubt.name == "few_points"]
    assert said == pytest.approx(off, abs=0.002) and abs(off) > 0.03
