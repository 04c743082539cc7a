"""Runs of dry blocks whose toes crush: the ledger closes, rocking dies down by it, and a resumed run is the same."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from tests.large.made import DENSITY, G, dry, slab
from tests.scenes import box

LENGTH, DEPTH, HEIGHT = 0.3, 0.2, 0.9
WEIGHT = DENSITY * G * LENGTH * DEPTH * HEIGHT
STRENGTH = 8.0 * WEIGHT / (LENGTH * DEPTH)


def rocking(joint: str, duration: float = 0.6, **options):
    """A slender block that is set off about the middle of its base."""
    boxes = [slab(2.0), box("block", (-0.5 * LENGTH, -0.5 * DEPTH, 0.0), (LENGTH, DEPTH, HEIGHT), "units", 1)]
    motion = '[[motion]]\non = "block"\nspin = ["0 rad/s", "1 rad/s", "0 rad/s"]\n'
    return dry(
        boxes, duration=duration, rows=60, stiff="1 GPa/m", shear="0.5 GPa/m", joint=joint, more=motion, **options
    )


CUT_OFF = f'crushing = "cut-off"\ncompressive_strength = "{STRENGTH!r} Pa"'


CAP = f'''crushing = "cap"
compressive_strength = "{STRENGTH!r} Pa"
fracture_energy_compression = "5 N/mm"
closing_at_peak = "0.2 mm"'''
AFFINE = {"kinematics": "affine", "material.units.young_modulus": "2 GPa", "material.units.poisson_ratio": "0.2"}
WORK = 0.5 * DENSITY * LENGTH * DEPTH * HEIGHT * HEIGHT**2 / 3.0


def closes(rows) -> None:
    """The ledger closes, and crushing only takes."""
    assert np.abs(rows["imbalance"]).max() < 1e-10 * WORK
    assert rows["crushing"][-1] > 1e-3 * WORK and np.all(np.diff(rows["crushing"]) >= 0.0)
    known = sum(rows[name] for name in ("elastic_contacts", "friction", "dashpot", "redetection", "area", "crushing"))
    assert rows["contact_work"] == pytest.approx(known, abs=1e-4 * WORK)


def test_a_block_that_rocks_crushes_its_toes_and_the_ledger_closes():
    closes(laboratory.run(rocking(CUT_OFF)).history.rows)


@pytest.mark.slow
def test_so_it_does_where_blocks_deform_and_crush_by_a_cap():
    closes(laboratory.run(rocking(CAP, 0.25, changes=AFFINE)).history.rows)
