"""Few points of patches that may crush are told."""

import pytest

from masonry.assembly.assemble import assemble
from masonry.laboratory.remarks.runs import crushed_toes
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


@pytest.mark.parametrize(("points", "said"), [(2, True), (4, True), (6, False), (None, False)])
def test_patches_with_fewer_points_than_a_toe_needs_are_told(points, said):
    more = "" if points is None else f"patch_points_per_edge = {points}"
    doubts = crushed_toes.doubts(inspected(assemble(scene(more, 'displacements = "large"\n')), []))
    assert [doubt.value > doubt.limit for doubt in doubts] == [True] * said
