"""What unlike points of a joint bear, by other reckonings: a section that is not symmetric, and a joint that is torn in
part."""

import numpy as np
import pytest

from geometry.joints.faces.strips import of_points, spread
from masonry.assembly.assemble import assemble
from masonry.estimates.joint_faces import faces_of
from masonry.estimates.joint_loads import JointWork, look_at, shear_of
from masonry.estimates.strength.joint_motions import slid
from masonry.estimates.strength.joint_sections import envelope, strength
from masonry.laws.brittle import Brittle
from masonry.laws.exponential import Exponential
from masonry.laws.state import JointProperties
from tests.judgement.frames import SIDE, frame, moved, on_a_slab
from tests.limit.one_block import block
from tests.scenes import load

JOINT = JointProperties(80e9, 35e9, tensile_strength=0.2e6, cohesion=0.3e6, tan_friction=0.7)
LIMIT = 0.2e6 / 80e9


def largest_moment(place: np.ndarray, area: np.ndarray, law, force: float, turns: np.ndarray) -> float:
    """Of all turns, where the force balances: by halving, from the opening at which nothing tears upwards."""
    largest = 0.0
    for turn in turns:
        e0 = np.linspace(-turn * place.max() - 4 * LIMIT, LIMIT - turn * place.min(), 4001)
        stress = np.where(
            (e := e0[:, None] + turn * place) < 0.0, law.stiffness * e, np.interp(e, law.opening, law.stress)
        )
        off, moment = stress @ area - force, stress @ (area * place)
        k = np.flatnonzero(off[:-1] * off[1:] <= 0.0)
        share = off[k] / (off[k] - off[k + 1])
        largest = max(largest, float((moment[k] + share * (moment[k + 1] - moment[k])).max(initial=0.0)))
    return largest


@pytest.mark.parametrize("force", [0.0, -900.0])
@pytest.mark.parametrize(
    ("place", "area"),
    [
        ([-0.02, 0.08], [0.012, 0.003]),
        ([-0.08, 0.02], [0.003, 0.012]),
        ([-0.03, 0.01, 0.1], [0.01, 0.005, 0.0025]),
    ],
)
def test_a_section_with_more_on_one_side_bears_the_largest_moment_of_all_openings(place, area, force):
    """Of a tough joint, whose two sides soften one after the other."""
    place, area = np.array(place), np.array(area)
    law, farthest = envelope(Exponential(3e4, 3e4), JOINT, 1e-2), 2e-3
    by_hand = largest_moment(place, area, law, force, np.geomspace(1e-6, farthest, 400))
    assert strength(of_points(place, area), law, force, 0.0, farthest) == pytest.approx(by_hand, rel=0.01)


@pytest.mark.parametrize(
    ("place", "area", "pressed"),
    [
        ([-0.02, 0.08], [0.012, 0.003], 0.0),
        ([-0.08, 0.02], [0.003, 0.012], 0.0),
        ([-0.01, 0.03], [0.003, 0.001], 0.0),
        ([-0.02, 0.08], [0.012, 0.003], 750.0),
    ],
)
def test_two_brittle_rows_bear_what_tears_the_one_that_opens(place, area, pressed):
    """Its strength and its share of the pressure, by the way to the other row, about which nothing has torn yet; once
    it has, pressure by the arm of the other one is less."""
    place, area = np.array(place), np.array(area)
    by_hand = (0.2e6 + pressed / area.sum()) * area[1] * (place[1] - place[0])
    borne = strength(of_points(place, area), envelope(Brittle(), JOINT, 1e-3), -pressed, 0.0, 1e-3)
    assert borne == pytest.approx(by_hand, rel=0.01)


def largest_of_cuts(depth: float, area: float) -> float:
    """m3: a triangle that tears from its tip bears most when some of the tip is gone (Timoshenko), over strength."""
    moduli = []
    for cut in np.linspace(0.0, 0.5, 51):
        y = np.linspace(cut, 1.0, 2001)
        whole, first, second = (np.trapezoid(y ** (power + 1), y) for power in (0, 1, 2))
        moduli.append((second - first**2 / whole) / (first / whole - cut))
    return 2.0 * area * depth * max(moduli)


@pytest.mark.parametrize("along", [1.0, -1.0])
def test_a_brittle_triangle_bears_its_elastic_moment_whichever_way_it_opens(along):
    """Askew: from its wide side, which lies a third of its depth from its middle, or from its tip."""
    corners = np.array([[0.0, 0.0, 0.0], [0.03, 0.2, 0.0], [-0.15, 0.1, 0.0]])
    wide = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0])
    out = along * np.array([wide[1], -wide[0], 0.0])
    section = spread([corners], out, np.cross([0.0, 0.0, 1.0], out), corners.mean(axis=0))
    depth, area = float(np.ptp(corners @ out)), 0.5 * abs(np.cross(corners[1], corners[2])[2])
    borne = strength(section, envelope(Brittle(), JOINT, 1e-3), 0.0, 0.0, 1e-3)
    by_hand = area * depth / 6.0 if along > 0.0 else largest_of_cuts(depth, area)
    assert section.area.sum() == pytest.approx(area, rel=0.01)
    assert borne == pytest.approx(0.2e6 * by_hand, rel=0.04)


@pytest.mark.parametrize("torn", [0.0, 0.25, 0.6])
def test_what_is_torn_of_a_joint_bears_no_shear_any_more(torn):
    """The block on ground, glued and not pressed, slides by 1 um askew: what it bears is the cohesion of the rest."""
    glue = 'law = "linear"\ntensile_strength = "50 kPa"\ncohesion = "100 kPa"\nresidual_cohesion = "0 Pa"\n'
    glue += 'fracture_energy_mode_1 = "50 N/m"\nfracture_energy_mode_2 = "500 N/m"\n'
    assembly = assemble(load(block("", glue)))
    points, way = len(assembly.joints.area), np.array([0.8e-6, -0.6e-6, 0.0])
    blocks = assembly.specimen.blocks
    corners = np.zeros_like(blocks.points)
    corners[
        np.concatenate(
            [blocks.face_points[blocks.face_start[f] : blocks.face_start[f + 1]] for f in blocks.faces_of(1)]
        )
    ] = way
    damage = np.where(np.arange(points) < points // 2, 0.5 * torn, 1.5 * torn)
    weights = assembly.joints.area / assembly.joints.area.sum()
    damage *= torn / max(float(weights @ damage), 1e-300)
    seen = frame(
        assembly, corners=corners, slip=np.full(points, 1e-6), shear_stress=np.full(points, 30e3), damage_tension=damage
    )
    faces = faces_of(assembly)
    work = JointWork(np.zeros(1), np.ones(1))
    one = slid(assembly, faces, look_at(assembly, faces, seen)._replace(work=work, inelastic=work),
               shear_of(assembly, faces, seen), seen, 0, np.ones(2))  # fmt: skip
    assert one is not None and one.carries == pytest.approx(30e3 / (100e3 * (1.0 - torn)), rel=0.01)


@pytest.mark.parametrize("turn", [0.02, -0.03])
def test_a_block_that_turns_on_its_bed_is_turned_and_twists_the_way_it_does(turn):
    """About the normal out of the slab, while it slides a little: its points rub along their ways."""
    assembly = on_a_slab()
    points = len(assembly.joints.area)
    seen = frame(assembly, corners=moved(assembly, 1, turn, (2e-4, -1e-4, 0.0)), shear_stress=np.full(points, 2e3))
    shear = shear_of(assembly, faces_of(assembly), seen)
    up = np.sign(assembly.joints.normal[0, 2])
    assert shear.turn == pytest.approx([np.sin(turn)], rel=1e-6) and up == 1.0
    assert shear.twist == pytest.approx([np.sign(turn) * 2e3 * SIDE**2 * SIDE / 2**0.5], rel=0.02)
