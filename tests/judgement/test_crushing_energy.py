"""The energy of a joint whose edge crushes, by few points: told by how much it may be off."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.detection.spread import rounds_of
from masonry.laboratory.remarks.runs import crushing_energy
from masonry.rows.columns import CRUSHING
from tests.judgement.frames import frame
from tests.judgement.test_limits_of_remarks import EITHER_SIDE, inspected
from tests.large.made import slab
from tests.scenes import box, listed, load, specimen, tables

SIDE, STRENGTH, SHARE, TURN = 0.2, 10e6, 0.2, 100.0


def scene(displacements: str, points: int, strength: float = STRENGTH, more: str = ""):
    """A block on a slab, that may crush at an edge."""
    where = "patch_points_per_edge" if displacements == "large" else 'contact_points = "gauss"\npoints_per_edge'
    contact = (
        'law = "friction"\nnormal_stiffness = "10 GPa/m"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = 0.6\n'
        f'compressive_strength = "{strength!r} Pa"\ncrushing = "cut-off"'
    )
    boxes = [slab(1.0), box("block", (0.0, 0.0, 0.0), (SIDE, SIDE, 0.1), "units", 1)]
    return load(
        f'displacements = "{displacements}"\nkinematics = "rigid"\n'
        + specimen(boxes, 0.01, more=f"{where} = {points}")
        + tables("material", {"units": 'density = "2000 kg/m^3"'})
        + tables("contact", {"unit_unit": contact})
        + listed("support", ['on = "slab"\nfix = "all"'])
        + '[drive]\non = "block"\ndirection = "z"\ndisplacement = "1 mm"\n'
        + more
    )


def inspection(displacements: str, points: int, energy: float, every: bool = False, **law):
    """The block turned far about an edge, under a fifth of what the joint bears; crushing took so much of 1 J."""
    assembly = assemble(scene(displacements, points, **law))
    if displacements == "large":
        assembly.model.alive[:] = False
    joints = assembly.joints
    x = joints.point[:, 0] - 0.5 * SIDE
    edge = np.where(x > 0.5 * x.max(), 1.0, 0.0)
    looked_at = frame(
        assembly,
        opening=-TURN * x,
        normal_stress=-SHARE * STRENGTH * SIDE**2 * edge / (joints.area @ edge),
        crushing=np.ones(len(x)) if every else edge,
    )
    run = inspected(assembly, [looked_at])
    run.outcome.history.rows = {CRUSHING: np.array([0.0, energy]), "external_work": np.array([0.0, 1.0])}
    return run


def by_hand(place: np.ndarray, area: np.ndarray) -> float:
    """Root mean square of the error of a stiff joint that turns: about the point at which the others bear its force;
    from the edge on, over length and area."""
    errors, shares = [], SHARE * np.linspace(0.8, 1.25, 16)
    for share in shares:
        end = int(np.searchsorted(np.cumsum(area), share))
        errors.append(area[:end] @ (place[end] - place[:end]) / (0.5 * share**2) - 1.0)
    return float(np.sqrt(np.mean(np.square(errors))))


def gauss(points: int) -> float:
    place, weight = np.polynomial.legendre.leggauss(points)
    return by_hand(0.5 * (1.0 + place), 0.5 * weight)


def lobatto(points: int) -> float:
    place, weight = rounds_of(points).T
    halves = np.concatenate([0.5 * (1.0 - place), 0.5 * (1.0 + place[::-1])])
    return by_hand(halves, 0.5 * np.concatenate([weight, weight[::-1]]))


@pytest.mark.parametrize(
    ("displacements", "points", "error"),
    [("small", 6, gauss(6)), ("small", 10, gauss(10)), ("large", 10, lobatto(10)), ("large", 20, lobatto(20))],
)
def test_few_points_at_an_edge_that_crushes_leave_its_energy_unknown(displacements, points, error):
    (doubt,) = crushing_energy.doubts(inspection(displacements, points, 0.5))
    assert doubt.value == pytest.approx(0.5 * error, rel=0.1)
    assert ("patch_points_per_edge" in doubt.advice) == (displacements == "large")


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_it_counts_from_three_hundredths_of_the_work_on(share, told):
    (whole,) = crushing_energy.doubts(inspection("small", 10, 1.0))
    assert bool(crushing_energy.doubts(inspection("small", 10, share * 0.03 / whole.value))) is told


def test_what_crushed_evenly_is_known():
    assert crushing_energy.doubts(inspection("small", 2, 1.0, every=True)) == []


def test_a_joint_that_hardly_turns_is_elastic_up_to_its_strength_and_bears_no_block():
    run = inspection("large", 10, 1.0)
    run.frames[0].opening[:] *= 1e-9
    assert crushing_energy.doubts(run) == []


def test_a_strength_that_was_drawn_counts_and_not_the_mean_of_its_group():
    """As of a joint that has it without a draw."""
    drawn = inspection("small", 10, 1.0, more="[scatter]\nseed = 7\n[scatter.unit_unit]\ncompressive_strength = 0.6\n")
    strength = float(np.unique(drawn.assembly.model.groups.properties[0].compressive_strength)[0])
    assert abs(strength / STRENGTH - 1.0) > 0.1
    (doubt,), (own,), (mean,) = map(
        crushing_energy.doubts, (drawn, inspection("small", 10, 1.0, strength=strength), inspection("small", 10, 1.0))
    )
    assert doubt.value == pytest.approx(own.value, rel=1e-12) and abs(doubt.value / mean.value - 1.0) > 0.01
