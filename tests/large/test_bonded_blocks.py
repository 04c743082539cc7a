"""Blocks that deform, bonded to a rigid one, both of them spinning: nothing of their energy or momentum gets lost."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from tests.scenes import box, load, specimen, tables

SPIN = 60.0
"""rad/s: 103 degrees in 0.03 s."""


def spinning(kind: str, fraction: float, deforms_first: bool):
    """A rigid and a soft block glued together, which spin about an axis askew; either may be side a of the bond."""
    boxes = [
        box("one", (0.0, 0.0, 0.0), (0.1, 0.1, 0.1), "bricks" if deforms_first else "units", 0),
        box("two", (0.1, 0.0, 0.0), (0.2, 0.1, 0.1), "units" if deforms_first else "bricks", 1),
    ]
    material = 'density = "2000 kg/m^3"\nyoung_modulus = "50 MPa"\npoisson_ratio = 0.2'
    glue = 'law = "elastic"\nnormal_stiffness = "1 GPa/m"\nshear_stiffness = "0.5 GPa/m"'
    motion = "".join(
        f'[[motion]]\non = "{name}"\nspin = ["10 rad/s", "20 rad/s", "{SPIN} rad/s"]\n'
        'about = ["0.15 m", "0.05 m", "0.05 m"]\n'
        for name in ("one", "two")
    )
    return load(
        f'displacements = "large"\nlaw = "friction"\nkinematics = {{default = "rigid", bricks = "{kind}"}}\n'
        + specimen(boxes, 0.01, more='mesh = "fan"')
        + tables("material", {"units": material, "bricks": material})
        + tables("contact", {"default": glue})
        + '[solver]\nmasses = "real"\ndamping = 0\nduration = "0.03 s"\nrows = 100\n'
        + f"step_fraction = {fraction}\n{motion}"
    )


@pytest.mark.slow
@pytest.mark.parametrize("deforms_first", [True, False])
@pytest.mark.parametrize("kind", ["affine", "tets"])
def test_what_a_spinning_bond_takes_up_is_what_it_stores(kind, deforms_first):
    left = []
    for fraction in (0.8, 0.4):
        result = laboratory.run(spinning(kind, fraction, deforms_first))
        rows, summary = result.history.rows, result.summary
        moved = rows["kinetic"][0]
        assert summary["rotation_max_rad"] > 1.5
        assert np.abs(rows["imbalance"]).max() < 1e-12 * moved
        assert rows["elastic_blocks"].max() > 5e-4 * moved
        stored = rows["elastic_contacts"]
        assert stored.max() > 5e-4 * moved
        left.append(np.abs(rows["contact_work"] - stored).max() / stored.max())
    assert left[0] < 1e-2
    assert left[1] < 0.3 * left[0], "of second order in the step"
