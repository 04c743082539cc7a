"""Plates, an arm and a lintel that twist about the normals of their joints: right, or told by how much they are not."""

import numpy as np
import pytest

import masonry
from masonry.estimates.strength.joint_planes import PlanePoints, ShearCurve, borne_in_plane
from masonry.judgement.judgement import judgement_of
from masonry.laboratory import laboratory
from tests.scenes import box, listed, load, specimen, tables

DENSITY = {"units": 'density = "2000 kg/m^3"'}
HELD = 'on = "g"\nfix = "all"'
GLUE = (
    'law = "linear"\nnormal_stiffness = "20 GPa/m"\nshear_stiffness = "8 GPa/m"\ntensile_strength = "0.2 MPa"\n'
    'cohesion = "0.2 MPa"\ntan_friction_angle = 0.6\nfracture_energy_mode_1 = "20 N/m"\n'
    'fracture_energy_mode_2 = "2000 N/m"'
)
DRY = 'law = "friction"\nnormal_stiffness = "20 GPa/m"\nshear_stiffness = "8 GPa/m"\ntan_friction_angle = 0.5'
STIFF = 'law = "elastic"\nnormal_stiffness = "{0} GPa/m"\nshear_stiffness = "{1} GPa/m"'
PUSHED = (
    '[limit]\npattern = "force"\non = "b"\nat = ["0.4 m", "0.2 m", "0 m"]\naccuracy = "0.5 %"\nup_to = 10000.0\n'
    '[limit.force]\ny = "1 kN"\n'
)
PLATE = [
    box("g", (-1.0, -1.0, -0.3), (3.0, 3.0, 0.3), "units", 0),
    box("b", (0.0, 0.0, 0.0), (0.4, 0.4, 0.1), "units", 1),
]


def plate(contact: str, points: str, more: str):
    """0.4 x 0.4 m on the ground, pushed along its side by 1 kN times a factor."""
    return load(
        'kinematics = "rigid"\n'
        + specimen(PLATE, 1.0, more=points)
        + tables("material", DENSITY)
        + tables("contact", {"unit_unit": contact})
        + listed("support", [HELD])
        + PUSHED
        + more
    )


def dry_plate(points: str):
    pressed = listed("traction", ['on = "b.z+"\nstress = {z = "-1 MPa"}'])
    return plate(DRY, points, '[gravity]\nz = "-9.81 m/s^2"\n' + pressed)


def arm(contact: str, within: tuple[float, float], points: str, displacement: str):
    """An arm of 1.2 m on a plate of 0.4 x 0.4 m, moved sideways at its middle."""
    boxes = [
        box("g", (-1.0, -1.0, -0.3), (1.4, 3.0, 0.3), "rock", 0),
        box("b", (0.0, 0.0, 0.0), (0.4, 0.4, 0.3), "units", 1),
        box("arm", (0.4, 0.0, 0.0), (1.2, 0.4, 0.3), "units", 1),
    ]
    flat = [f'on = "{name}"\nfix = ["z", "rotation x", "rotation y"]' for name in ("b", "arm")]
    inner = STIFF.format(*within)
    return load(
        'kinematics = "rigid"\n'
        + specimen(boxes, 0.16, more=points)
        + tables("material", DENSITY | {"rock": 'density = "2000 kg/m^3"'})
        + tables("contact", {"rock_units": contact, "within_units": inner})
        + listed("support", [HELD, *flat])
        + f'[drive]\non = "arm"\ndirection = "y"\ndisplacement = "{displacement}"\n[solver]\nslip_limit = 10.0\n'
    )


def told(summary, name: str) -> float:
    """The value of a doubt; 0 where there is none."""
    return next((doubt.value for doubt in judgement_of(summary).doubts if doubt.name == name), 0.0)


@pytest.mark.parametrize(
    ("points", "off"),
    [
        ('contact_points = "vertex"', 0.3212),
        ('contact_points = "gauss"', 0.0191),
        ('contact_points = "vertex"\npoints_per_edge = 4', 0.0),
        ('contact_points = "gauss"\npoints_per_edge = 6', 0.0),
    ],
)
def test_a_dry_plate_that_slides_and_twists_says_by_how_much_it_is_too_strong(points, off):
    """46.06 by an even pressure and a search for its centre."""
    summary = laboratory.run(dry_plate(points)).summary
    assert summary["collapse_load"].borne == pytest.approx(46.06 * (1.0 + off), rel=0.01)
    assert told(summary, "few_points") == pytest.approx(off, abs=0.005)


@pytest.mark.parametrize(("patches", "off"), [("corners", 0.3207), ("spread", 0.0)])
def test_patches_of_such_a_plate_say_by_how_much_it_turns_too_late(patches, off):
    """Right is the load at which it turns away; it comes to rest behind that, where the force passes its middle."""
    large = {"displacements": "large", "specimen.patch_points": patches, "limit.travel": "1 mm"}
    summary = laboratory.run(dry_plate("").with_(large)).summary
    assert summary["collapse_load"].borne == pytest.approx(46.06 * (1.0 + off), rel=0.01)
    assert told(summary, "few_points") == pytest.approx(off, abs=0.005)


@pytest.mark.parametrize("words", [{}, {"dilation": False}])
def test_a_limit_analysis_of_joints_that_twist_says_by_how_much_less_it_may_fall(words):
    result = masonry.limit(dry_plate('contact_points = "vertex"'), **words)
    assert result.factor == pytest.approx(60.86, rel=1e-3)
    (remark,) = [line for line in result.remarks if "twist" in line]
    assert "about 24 % less" in remark, 1.0 - 46.06 / 60.86


def test_a_glued_plate_that_twists_says_so_too():
    """18.39 by the cohesion all over."""
    summary = laboratory.run(plate(GLUE, 'contact_points = "vertex"', '[gravity]\nz = "-0.001 m/s^2"\n')).summary
    assert summary["collapse_load"].borne == pytest.approx(24.3, rel=0.01)
    assert told(summary, "few_points") == pytest.approx(24.3 / 18.39 - 1.0, abs=0.01)


@pytest.mark.parametrize("along", [2, 4])
def test_an_arm_of_mortar_that_a_drive_twists_is_told_too(along):
    """5964 N by 12 Gauss points and more."""
    tough = GLUE.replace('mode_1 = "20 N/m"', 'mode_1 = "200 N/m"')
    run = laboratory.run(arm(tough, (2000.0, 800.0), f'contact_points = "gauss"\npoints_per_edge = {along}', "4 mm"))
    off = run.summary["peak_force_n"] / 5940.0 - 1.0
    assert (off > 0.05) == (along == 2) and told(run.summary, "few_points") == pytest.approx(max(off, 0.0), abs=0.012)


@pytest.mark.parametrize(("along", "force"), [(2, 14130.0), (3, 5088.0), (4, 5088.0)])
def test_an_elastic_joint_twists_as_its_polar_moment_says_from_three_points_at_the_edges_on(along, force):
    """ks J of a square, and with two points three times as stiffly: by the arm of the drive, at 0.1 mm."""
    elastic = STIFF.format(20.0, 8.0)
    where = f'contact_points = "vertex"\npoints_per_edge = {along}'
    summary = laboratory.run(arm(elastic, (2000.0, 800.0), where, "0.1 mm")).summary
    if along > 2:
        assert summary["peak_force_n"] == pytest.approx(force, rel=0.01)
    assert (told(summary, "closed_joints") > 0.3) == (along == 2)


def test_a_lintel_that_is_pushed_at_one_end_twists_on_both():
    """1.5504 by six Gauss points and more; 1.661 to 1.666 at the corners."""
    boxes = [
        box("g1", (0.0, 0.0, -0.5), (0.4, 0.4, 0.5), "units", 0),
        box("g2", (1.6, 0.0, -0.5), (0.4, 0.4, 0.5), "units", 1),
        box("li", (0.0, 0.0, 0.0), (2.0, 0.4, 0.3), "units", 2),
    ]
    scene = load(
        'kinematics = "rigid"\n'
        + specimen(boxes, 1.0, more='contact_points = "vertex"')
        + tables("material", DENSITY)
        + tables("contact", {"unit_unit": DRY.replace("0.5", "0.6")})
        + listed("support", ['on = "g1"\nfix = "all"', 'on = "g2"\nfix = "all"'])
        + '[gravity]\nz = "-9.81 m/s^2"\n[limit]\npattern = "force"\non = "li"\nat = ["1.8 m", "0.2 m", "0 m"]\n'
        'accuracy = "0.5 %"\n[limit.force]\ny = "1 kN"\n'
    )
    summary = laboratory.run(scene).summary
    off = summary["collapse_load"].borne / 1.5504 - 1.0
    assert off > 0.06 and told(summary, "few_points") == pytest.approx(off, abs=0.02)


OUT_OF_PLANE = [
    box("lower", (0.0, 0.0, 0.0), (1.0, 0.2, 0.2), "units", 0),
    box("upper", (0.0, 0.0, 0.2), (1.0, 0.2, 2.0), "units", 1),
]
CUT_OFF = 'crushing = "cut-off"\ncompressive_strength = "5 MPa"', 1.0, 16000.0
CAP = (
    'crushing = "cap"\ncompressive_strength = "5 MPa"\nfracture_energy_compression = "8 N/mm"\n'
    'closing_at_peak = "0.1 mm"',
    0.25,
    4740.0,
)


@pytest.mark.parametrize(("crushing", "pressure", "right"), [CUT_OFF, CAP])
@pytest.mark.parametrize("points", ["", "points_per_edge = {x = 6, y = 2, z = 6}"])
def test_a_wall_that_is_bent_across_its_thickness_is_within_3_percent_by_default_and_told(
    crushing, pressure, right, points
):
    """N t/2 (1 - N/(f A)) of a stress block at 2 m; of the cap by strips, and at most 5 % above that by its points."""
    stiff = 'law = "friction"\nnormal_stiffness = "50 GPa/m"\nshear_stiffness = "20 GPa/m"\ntan_friction_angle = 2.0\n'
    scene = load(
        'kinematics = "rigid"\n'
        + specimen(OUT_OF_PLANE, 0.2, more=points)
        + tables("material", DENSITY)
        + tables("contact", {"unit_unit": stiff + crushing})
        + listed("support", ['on = "lower"\nfix = "all"', 'on = "upper"\nfix = ["x", "rotation y", "rotation z"]'])
        + listed("traction", [f'on = "upper.z+"\nstress = {{z = "-{pressure} MPa"}}'])
        + '[drive]\non = "upper"\ndirection = "y"\ndisplacement = "4 mm"\naccuracy = "0.5 %"\n'
    )
    summary = laboratory.run(scene).summary
    off = summary["peak_force_n"] / right - 1.0
    assert told(summary, "few_points") == pytest.approx(off, abs=0.04) and (told(summary, "few_points") != 0.0)
    assert (abs(off) > 0.2) == bool(points) and (abs(off) < 0.03) != bool(points)


def test_what_softens_to_nothing_bears_what_it_bore_first():
    """Evenly pushed along its plane, a glued face bears its cohesion on its area, however far it slid afterwards."""
    place, area = np.array([[-1.0, -0.4], [1.2, -0.3], [0.1, 0.9]]), np.array([0.3, 0.25, 0.35])
    place -= area @ place / area.sum()
    strong = np.full(3, 2e5)
    law = ShearCurve(8e9, np.array([0.0, 1e-5, 1.0]), np.array([1.0, 0.0, 0.0]))
    for farthest in (1e-5, 1e-3, 0.5):
        bears = borne_in_plane(PlanePoints(place, area, strong, np.zeros(3)), law, np.array([3.0, 4.0]), 0.0, farthest)
        assert 5.0 * bears == pytest.approx(2e5 * area.sum(), rel=0.01)


@pytest.mark.parametrize(("cohesion", "accuracy"), [("1.16 MPa", "0.5 %"), ("0.65 MPa", "2 %")])
def test_a_joint_that_breaks_at_once_bears_its_whole_strength_until_then(cohesion, accuracy):
    """Held against what is left, it was told to bear 2.8 and 4.4 times what it should."""
    pressed = {"law": "brittle", "confinement": "0.55 MPa", "specimen.length": "0.31 m", "drive.accuracy": accuracy}
    summary = masonry.run(masonry.load("couplet", pressed | {"contact.unit_unit.cohesion": cohesion})).summary
    bears = 1e6 * float(cohesion.split()[0]) + 1.01 * 0.55e6
    assert summary["peak_stress_pa"] == pytest.approx(bears, rel=0.01)
    assert told(summary, "few_points") == 0.0
