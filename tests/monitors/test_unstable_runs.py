"""Runs with too long a step are stopped, with a block to blame; eq. (11) can ask for one."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import Stopped
from masonry.laboratory import laboratory
from masonry.scene import load as load_shipped
from tests.model.eigen import true_limit
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables


def tower(kinematics: str, solver: str, steps: int = 20000) -> str:
    """Two blocks on a held one, under their weight: small enough to know its exact limit."""
    boxes = [box(f"b{k}", (0, 0, 0.06 * k), (0.2, 0.1, 0.06), g, k) for k, g in enumerate(("base", "units", "units"))]
    return (
        f'kinematics = {{default = "{kinematics}", base = "rigid"}}\n'
        + specimen(boxes, 0.02, "200 mm")
        + tables("material", dict.fromkeys(("base", "units"), MATERIAL))
        + tables("contact", {"base_units": ELASTIC, "unit_unit": ELASTIC})
        + listed("support", ['on = "b0"\nfix = "all"'])
        + f'[gravity]\nz = "-9.81 m/s^2"\nx = "2 m/s^2"\n[settle]\nsteps = {steps}\n'
        + f'[solver]\nmasses = "real"\n{solver}\n'
    )


@pytest.mark.parametrize("damping", [0.0, 0.8])
@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_a_run_above_the_true_limit_is_stopped_with_a_block_to_blame_and_finite_rows(kinematics, damping):
    model = assemble(load(tower(kinematics, "damping = 0.0"))).model
    limit = true_limit(model) / float(np.sqrt(1.0 + damping))
    scene = load(tower(kinematics, f'damping = {damping!r}\ntime_step = "{1.01 * limit!r} s"'))
    assert any("above the proven bound" in warning for warning in laboratory.check(scene)["warnings"])
    with pytest.raises(Stopped, match="unstable at step .*block") as stop:
        laboratory.run(scene)
    result = stop.value.result
    assert result.summary["stopped"] == str(stop.value)
    assert len(result.history.rows["step"]) >= 1
    assert all(np.isfinite(values).all() for values in result.history.rows.values())
    assert all(
        np.isfinite(getattr(f, name)).all() for f in result.history.frames for name in ("corners", "nodes", "stress")
    )


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_a_time_step_ten_times_too_long_is_stopped_at_once_without_nan(kinematics):
    model = assemble(load(tower(kinematics, "damping = 0.0"))).model
    scene = load(tower(kinematics, f'time_step = "{10 * model.bound!r} s"'))
    with pytest.raises(Stopped, match="block") as stop:
        laboratory.run(scene)
    assert all(np.isfinite(values).all() for values in stop.value.result.history.rows.values())
    assert stop.value.result.summary["steps"] < 1000


def test_equation_11_is_as_printed():
    scene = load(tower("rigid", 'time_step = "equation-11"\ndamping = 0.0'))
    mass, stiffness = 1900 * 0.2 * 0.1 * 0.06, 200e9 * 0.2 * 0.1 / 4  # four contact points on a face
    model = assemble(scene).model
    assert model.dt == pytest.approx(2 * 0.1 * np.sqrt(mass / stiffness), rel=1e-12)
    half = assemble(load(tower("rigid", 'time_step = "equation-11"\ndamping = 0.0\nstep_fraction = 0.05'))).model
    assert half.dt == pytest.approx(0.5 * model.dt, rel=1e-12)


def test_equation_11_is_unsafe_for_soft_contacts_beside_stiff_blocks():
    """It sees no zone stiffness: at the paper's own fraction it lies above the exact limit, too."""
    text = tower("affine", 'time_step = "equation-11"\ndamping = 0.8').replace("GPa/m", "MPa/m")
    model = assemble(load(text)).model
    exact = true_limit(model)
    assert model.dt > model.bound
    assert model.dt > exact
    with pytest.raises(Stopped, match="block"):
        laboratory.run(load(text))


@pytest.mark.parametrize(("damping", "rate"), [(0.0, "8 mm/s"), (0.8, "1 mm/s")])
def test_an_instability_that_softening_keeps_small_is_stopped_by_the_ledger(damping, rate):
    scene = load_shipped(
        "wallette-mode-1",
        ["solver.step_fraction=1.4", f"solver.damping={damping}", f"drive.rate={rate}"],
    )
    with pytest.raises(Stopped, match=r"unstable at step \d+: rigid block \d+"):
        laboratory.run(scene)
