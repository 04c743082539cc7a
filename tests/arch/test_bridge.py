"""Bridges of several arches on piers: what is built, what it bears by lines of thrust, what is refused."""

import numpy as np
import pytest

import masonry
from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import volumes
from geometry.structures.bridge import BridgeArch, Pier, bridge
from masonry.errors import SceneError
from masonry.scene import load
from verification.references.thrust_line import Spans, added, ring

G, TAN = 9.81, float(np.tan(np.radians(26.565)))
UNEQUAL = {
    "specimen.arch": [
        {"span": "4 m", "rise": "1 m", "thickness": "0.3 m", "voussoirs": 13},
        {"span": "6 m", "rise": "2.2 m", "thickness": "0.5 m", "voussoirs": 17},
        {"span": "3 m", "rise": "1.5 m", "thickness": "0.4 m", "voussoirs": 11},
    ],
    "specimen.pier": [
        {"width": "1.2 m", "height": "2 m", "courses": 3},
        {"width": "1.6 m", "height": "4 m", "courses": 10},
    ],
    "fill.0.level": "3 m",
    "vehicle.level": "3 m",
    "vehicle.axles": ["60 kN", "120 kN", "110 kN"],
    "vehicle.spacings": ["1.5 m", "0.9 m"],
}
BY_HAND = Spans(
    (ring(4.0, 1.0, 0.3, 13, 2.0), ring(6.0, 2.2, 0.5, 17, 8.2), ring(3.0, 1.5, 0.4, 11, 14.3)),
    ((1.2, 2.0, 3), (1.6, 4.0, 10)),
)


def test_volumes_joints_and_sets_are_those_of_the_drawing():
    arches = [BridgeArch(5.0, 1.2, 0.4, 21), BridgeArch(3.0, 1.5, 0.3, 9)]
    specimen = bridge(arches, [Pier(1.0, 3.0, 6)], 2.0)
    count = 21 + 9 + 7 + 2
    assert specimen.blocks.count == count and specimen.section == 0.8
    sets = specimen.sets
    assert [len(sets[name]) for name in ("voussoirs", "pier 1", "extrados", "foundations")] == [30, 6, 31, 3]
    assert sets["arch 2 keystone"].tolist() == [25] and sets["arch 2 voussoir 9"].tolist() == [29]
    volume = volumes(specimen.blocks)
    inner = (0.25 * 25.0 + 1.44) / 2.4
    half = float(np.arcsin(2.5 / inner))
    piece = np.sin(half / 21) * np.cos(half / 21)
    ring_of_polygon = 21 * piece * ((inner + 0.4) ** 2 - inner**2)
    assert volume[sets["arch 1"]].sum() == pytest.approx(2.0 * ring_of_polygon)
    assert volume[sets["pier 1"]][:-1] == pytest.approx(2.0 * 1.0 * 0.5)
    above = 0.5 * 0.4 * np.cos(half) * (1.0 - 0.3)  # a triangle: the semicircle springs level from 0.3 m of the pier
    assert volume[sets["pier 1 springer"]] == pytest.approx(2.0 * (0.5 + above))
    joints = find_joints(specimen.blocks)
    area = np.bincount(joints.patch, joints.area)
    assert len(area) == 22 + 10 + 6
    assert np.sort(area) == pytest.approx(np.sort([*[0.8] * 22, *[0.6] * 10, *[2.0] * 6]))
    points = specimen.blocks.points
    assert points[:, 0].min() == pytest.approx(-0.4 * np.sin(half)) and points[:, 0].max() == pytest.approx(9.3)


def test_one_arch_needs_no_pier_and_is_an_arch():
    one = {"specimen.arch": [{"span": "5 m", "rise": "1.2 m", "thickness": "0.4 m", "voussoirs": 25}]}
    one |= {"specimen.pier": [], "vehicle.axles": ["100 kN"], "vehicle.spacings": []}
    result = masonry.limit(load("bridge", one | {"vehicle.position": "3.8 m"}))
    assert result.factor == pytest.approx(
        masonry.limit(load("bridge-single-span", {"vehicle.position": "1.3 m"})).factor, rel=1e-9
    )


@pytest.mark.parametrize("position", [1.0, 3.9, 7.2, 9.6, 13.7])
@pytest.mark.parametrize("way", ["x", "-x"])
def test_arches_of_three_kinds_bear_what_lines_of_thrust_through_arches_and_piers_bear(position, way):
    scene = load("bridge", UNEQUAL | {"vehicle.position": f"{position} m", "vehicle.direction": way})
    extrados, places = BY_HAND.extrados, scene.vehicle.places(position, way)
    live = added(*(extrados.under_axle(p, x, 3.0, 0.3, TAN) for p, x in zip(scene.vehicle.axles, places, strict=True)))
    own = BY_HAND.largest_factor(2200 * G, added(extrados.filled(3.0, 1800 * G)), live, 0.7)
    assert masonry.limit(scene).factor == pytest.approx(own, rel=1e-9)


def test_a_slender_pier_moves_and_a_stocky_one_leaves_its_arch_alone():
    slender = masonry.limit("bridge")
    assert slender.moving[slender.specimen.sets["pier 1"]].all()
    stocky = [masonry.limit(load("bridge", {"specimen.pier.0.width": f"{b} m"})) for b in (2.0, 3.0)]
    for result in stocky:
        assert not result.moving[result.specimen.sets["pier 1"]].any()
        beside = [bool(result.moving[result.specimen.sets[f"arch {k}"]].any()) for k in (1, 2)]
        assert sorted(beside) == [False, True]
    assert slender.factor < 0.6 * stocky[0].factor
    assert stocky[0].factor == pytest.approx(stocky[1].factor, rel=1e-6)


def test_the_envelope_of_two_equal_spans_is_symmetric_about_the_pier():
    result = masonry.limit(load("bridge", {"vehicle.between": ["0.5 m", "10.5 m"]}))
    position, factor = result.envelope.along("x")
    at = [int(np.argmin(np.abs(position - x))) for x in np.linspace(0.5, 10.5, 87)]
    assert position[at] == pytest.approx(np.linspace(0.5, 10.5, 87), abs=1e-9)
    assert factor[at] == pytest.approx(factor[at][::-1], rel=1e-7)


WRONG = {
    "pier": ({"specimen.pier": []}, "2 arches have 1 piers between them; here are 0"),
    "span": ({"specimen.arch.0.spam": "5 m"}, "did you mean 'span'"),
    "width": ({"specimen.pier.0.widht": "5 m"}, "did you mean 'width'"),
    "rise": ({"specimen.arch.1.rise": "2.6 m"}, "half of the span or less, 2.5 m"),
    "arches": ({"specimen.arches": []}, "did you mean 'arch'"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_with_a_bridge_is_said_in_one_message(case):
    changes, words = WRONG[case]
    with pytest.raises(SceneError) as error:
        load("bridge", changes)
    assert words in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("arches", "piers", "words"),
    [
        ([(5, 1.2, 0.4, 21)] * 2, [(0.6, 3, 4)], "the rings of both arches need 0.624"),
        ([(5, 1.2, 0.4, 21)] * 2, [], "2 arches have 1 piers; here are 0"),
        ([(5, 2.6, 0.4, 21)], [], "at most half of the span; nearest: 2.5 m"),
        ([(5, 2.5, 0.4, 1)], [], "number of voussoirs is 1"),
        ([], [], "0 arches"),
    ],
)
def test_a_bridge_that_cannot_be_built_is_refused(arches, piers, words):
    with pytest.raises(GeometryError, match=words):
        bridge([BridgeArch(*one) for one in arches], [Pier(*one) for one in piers], 1.0)


def test_rings_that_meet_on_a_pier_leave_no_top_on_its_springer():
    arches, half = [BridgeArch(5.0, 1.2, 0.4, 21)] * 2, float(np.arcsin(2.5 / ((6.25 + 1.44) / 2.4)))
    specimen = bridge(arches, [Pier(0.8 * np.sin(half), 3.0, 4)], 1.0)
    assert len(find_joints(specimen.blocks).patch_start) - 1 == 44 + 4
