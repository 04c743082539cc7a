"""Few rows of points at a joint whose edge crushes: told where they bear another moment than a stress block."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.laboratory.remarks.runs import crushed_toes
from tests.judgement.frames import frame
from tests.judgement.test_limits_of_remarks import inspected
from tests.large.made import slab
from tests.scenes import box, listed, load, specimen, tables

SIDE, STRENGTH, SHARE = 0.2, 10e6, 0.1


def scene(more: str, top: str = ""):
    """A block on a slab, which may crush at its edges."""
    boxes = [slab(1.0), box("block", (0.0, 0.0, 0.0), (SIDE, SIDE, 0.1), "units", 1)]
    contact = (
        'law = "friction"\nnormal_stiffness = "10 GPa/m"\nshear_stiffness = "5 GPa/m"\ntan_friction_angle = 0.6\n'
        f'compressive_strength = "{STRENGTH!r} Pa"\ncrushing = "cut-off"'
    )
    return load(
        f'{top}kinematics = "rigid"\n'
        + specimen(boxes, 0.01, more=more)
        + tables("material", {"units": 'density = "2000 kg/m^3"'})
        + tables("contact", {"unit_unit": contact})
        + listed("support", ['on = "slab"\nfix = "all"'])
        + '[drive]\non = "block"\ndirection = "z"\ndisplacement = "1 mm"\n'
    )


def inspection(points: int, where: str, every: bool = False, closing: float = 1e-3):
    """The block's edge presses by as much as SHARE of its area crushes, and closed for good (m)."""
    assembly = assemble(scene(f'contact_points = "{where}"\npoints_per_edge = {points}'))
    joints, crushed = assembly.joints, assembly.model.state.crushed
    x = joints.point[:, 0] - SIDE / 2
    pressed = np.where(x > 0.5 * x.max(), 1.0, 0.0)
    crushed[:, 0] = closing if every else closing * pressed
    stress = -SHARE * STRENGTH * SIDE**2 * pressed / (joints.area @ pressed)
    run = inspected(assembly, [frame(assembly, normal_stress=stress)])
    run.peak = 0
    return run


@pytest.mark.parametrize(
    ("points", "where", "off"),
    [(2, "gauss", -0.358), (4, "gauss", -0.043), (10, "gauss", None), (2, "vertex", 0.111), (20, "vertex", None)],
)
def test_few_rows_at_a_crushed_edge_are_told_by_how_much_they_are_off(points, where, off):
    doubts = crushed_toes.doubts(inspection(points, where))
    assert [doubt.value for doubt in doubts] == ([] if off is None else [pytest.approx(off, abs=3e-3)])
    assert all(("more" if off > 0.0 else "less") in doubt.sentence for doubt in doubts)


def test_a_joint_that_is_crushed_evenly_does_not_bend():
    assert crushed_toes.doubts(inspection(2, "gauss", every=True)) == []


@pytest.mark.parametrize(("closing", "said"), [(0.99e-4, False), (1.01e-4, True)])
def test_an_edge_that_only_begins_to_crush_bears_a_wedge_and_no_block(closing, said):
    """The joint presses by its strength at 1 mm."""
    assert bool(crushed_toes.doubts(inspection(2, "gauss", closing=closing))) is said


@pytest.mark.parametrize(("points", "said"), [(2, True), (4, True), (6, False), (None, False)])
def test_patches_with_fewer_points_than_a_toe_needs_are_told(points, said):
    more = "" if points is None else f"patch_points_per_edge = {points}"
    doubts = crushed_toes.doubts(inspected(assemble(scene(more, 'displacements = "large"\n')), []))
    assert [doubt.value > doubt.limit for doubt in doubts] == [True] * said
