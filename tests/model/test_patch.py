"""Patch tests: a stack under uniform stress relaxes to exactly that stress, and to its exact displacement."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from tests.scenes import ELASTIC, MATERIAL, SLIPPERY, box, listed, load, specimen, tables

E, NU, KN, KS = 5e9, 0.2, 2e11, 8e10
SIZE = (0.2, 0.1)
AREA = SIZE[0] * SIZE[1]
HEIGHTS = (0.05, 0.08, 0.06)
EXACT = 1e-9
SOLVER = '[settle]\nsteps = {steps}\n[solver]\nmasses = "scaled"\ndamping = 0.8\nrows = 50\n'


def stack(units: str, ends: str | None, divided: bool, end_group: str = "plates") -> tuple[str, list[str]]:
    """Specimen of three units, with a block of `end_group` below and above where `ends` names its kinematics."""
    level, boxes, names = 0.0, [], []
    layers = [(f"unit {k}", h, "units", k) for k, h in enumerate(HEIGHTS)]
    if ends is not None:
        layers = [("below", 0.03, end_group, 7), *layers, ("above", 0.03, end_group, 8)]
    for name, height, group, unit in layers:
        cells = (2, 2, 1) if divided and name == "unit 1" else (1, 1, 1)
        boxes.append(box(name, (0, 0, level), (*SIZE, height), group, unit, cells))
        names.append(name)
        level += height
    kinematics = (
        f'kinematics = {{default = "{units}", {end_group} = "{ends}"}}\n' if ends else f'kinematics = "{units}"\n'
    )
    return kinematics + specimen(boxes, AREA), names


def finish(text: str, contacts: dict[str, str], ends: str | None, steps: int, end_group: str = "plates", **rest) -> str:
    materials = {"units": MATERIAL} | ({end_group: MATERIAL} if ends else {})
    return (
        text
        + tables("material", materials)
        + tables("contact", {"unit_unit": ELASTIC, "within_units": ELASTIC} | contacts)
        + "".join(listed(name, entries) for name, entries in rest.items())
        + SOLVER.format(steps=steps)
    )


def blocks_of(result, names):
    return np.concatenate([result.specimen.sets[name] for name in names])


def moved(result, block):
    """Corners of a block and their displacements."""
    blocks = result.specimen.blocks
    points = np.unique(
        np.concatenate(
            [blocks.face_points[blocks.face_start[f] : blocks.face_start[f + 1]] for f in blocks.faces_of(block)]
        )
    )
    return blocks.points[points], result.history.frames[-1].corners[points]


def assert_uniform(result, stress, sigma_z, units, elastic):
    """Stress (6,) in every elastic unit, sigma_z across level joints and nothing across upright ones."""
    frame, scale = result.history.frames[-1], np.abs(stress).max()
    if elastic:
        which = blocks_of(result, units)
        assert np.abs(frame.stress[which] - stress).max() < EXACT * scale
    level = np.abs(result.joints.normal[:, 2]) > 0.5
    assert np.abs(frame.normal_stress[level] - sigma_z).max() < EXACT * scale
    assert np.abs(frame.normal_stress[~level]).max(initial=0.0) < EXACT * scale


@pytest.mark.parametrize("sigma", [0.4e6, -2.5e6], ids=["tension", "compression"])
@pytest.mark.parametrize(
    "units, ends, group, steps",
    [
        ("rigid", "rigid", "plates", 4000),
        ("affine", "rigid", "plates", 6000),
        ("affine", "affine", "caps", 6000),
        ("tets", "rigid", "plates", 12000),
    ],
)
def test_a_stack_between_frictionless_ends_takes_uniform_normal_stress_exactly(units, ends, group, steps, sigma):
    text, names = stack(units, ends, divided=True, end_group=group)
    touching = "plate" if group == "plates" else "caps_units"
    fix = '["x", "y", "z", "rotation"]'
    scene = load(
        finish(
            *(text, {touching: SLIPPERY}, ends, steps, group),
            support=[f'on = "below"\nfix = {fix}', 'on = "above"\nfix = ["x", "y", "rotation"]'],
            traction=[f'on = "above.z+"\nstress = {{z = "{sigma!r} Pa"}}'],
        )
    )
    result = laboratory.run(scene)
    units_of_stack = [name for name in names if name.startswith("unit")]
    strain = 0.0 if units == "rigid" else sigma / E
    assert_uniform(result, np.array([0, 0, sigma, 0, 0, 0]), sigma, units_of_stack, units != "rigid")
    assert np.abs(result.history.frames[-1].shear_stress).max() < EXACT * abs(sigma)

    total = 4 * sigma / KN + strain * sum(HEIGHTS)
    level, base, corners, errors = 0.03, 0.0, [], []
    for k, height in enumerate(HEIGHTS):
        base += sigma / KN
        for block in result.specimen.sets[f"unit {k}"]:
            corner, move = moved(result, block)
            exact = np.column_stack([-NU * strain * corner[:, :2], base + strain * (corner[:, 2] - level)])
            corners.append(corner)
            errors.append(move - exact)
        base, level = base + strain * height, level + height
    assert np.abs(without_floating(np.concatenate(corners), np.concatenate(errors))).max() < EXACT * abs(total)
    if ends == "rigid":
        move = moved(result, result.specimen.sets["above"][0])[1]
        assert np.abs(move - [0.0, 0.0, total]).max() < EXACT * abs(total)


def without_floating(points, errors):
    """Errors less the horizontal shift and turn that frictionless ends leave free."""
    one, zero = np.ones(len(points)), np.zeros(len(points))
    x, y = points[:, 0], points[:, 1]
    modes = np.stack([np.stack([one, zero, -y]), np.stack([zero, one, x]), np.stack([zero, zero, zero])])
    modes = modes.transpose(2, 0, 1).reshape(-1, 3)
    flat = errors.ravel()
    return flat - modes @ np.linalg.lstsq(modes, flat, rcond=None)[0]


@pytest.mark.parametrize("sigma", [0.4e6, -2.5e6], ids=["tension", "compression"])
@pytest.mark.parametrize("units, steps", [("tets", 12000), ("rigid", 4000)])
def test_a_stack_on_three_rollers_takes_uniform_normal_stress_exactly(units, steps, sigma):
    text, names = stack(units, None, divided=True)
    sides = [f'on = "{name}.{axis}-"\nfix = ["{axis}"]' for name in names for axis in "xy"]
    scene = load(
        finish(
            *(text, {}, None, steps),
            support=['on = "unit 0.z-"\nfix = ["z"]', *sides],
            traction=[f'on = "unit 2.z+"\nstress = {{z = "{sigma!r} Pa"}}'],
        )
    )
    result = laboratory.run(scene)
    strain = 0.0 if units == "rigid" else sigma / E
    assert_uniform(result, np.array([0, 0, sigma, 0, 0, 0]), sigma, names, units != "rigid")
    total = strain * sum(HEIGHTS) + 2 * sigma / KN
    level, base = 0.0, 0.0
    for k, height in enumerate(HEIGHTS):
        for block in result.specimen.sets[f"unit {k}"]:
            corner, move = moved(result, block)
            exact = np.column_stack([-NU * strain * corner[:, :2], base + strain * (corner[:, 2] - level)])
            assert np.abs(move - exact).max() < EXACT * abs(total)
        base, level = base + strain * height + sigma / KN, level + height


@pytest.mark.parametrize(
    "units, ends, group, steps",
    [
        ("rigid", "rigid", "plates", 8000),
        ("affine", "rigid", "plates", 10000),
        ("affine", "affine", "caps", 10000),
        ("tets", "rigid", "plates", 20000),
        ("tets", None, "", 20000),
    ],
)
def test_a_stack_sheared_on_all_its_sides_takes_uniform_shear_exactly(units, ends, group, steps):
    tau = 0.3e6
    text, names = stack(units, ends, divided=False, end_group=group)
    touching = {} if ends is None else {"plate" if group == "plates" else "caps_units": ELASTIC}
    loaded = names if ends is None else names[1:]
    sides = [
        f'on = "{name}.x{side}"\nstress = {{z = "{tau if side == "+" else -tau!r} Pa"}}'
        for name in loaded
        for side in "+-"
    ]
    bottom = "unit 0.z-" if ends is None else "below"
    scene = load(
        finish(
            *(text, touching, ends, steps, group),
            support=[f'on = "{bottom}"\nfix = "all"'],
            traction=[f'on = "{names[-1]}.z+"\nstress = {{x = "{tau!r} Pa"}}', *sides],
        )
    )
    result = laboratory.run(scene)
    frame = result.history.frames[-1]
    units_of_stack = [name for name in names if name.startswith("unit")]
    stress = np.array([0, 0, 0, 0, tau, 0])
    assert_uniform(result, stress, 0.0, units_of_stack, units != "rigid")
    assert np.abs(frame.shear_stress - tau).max() < EXACT * tau

    slope = 0.0 if units == "rigid" else tau / (E / (2 * (1 + NU)))
    joints = len(HEIGHTS) - 1 if ends is None else len(HEIGHTS) + 1
    total = joints * tau / KS + slope * sum(HEIGHTS)
    level, base = (0.0, -tau / KS) if ends is None else (0.03, 0.0)
    for k, height in enumerate(HEIGHTS):
        base += tau / KS
        for block in result.specimen.sets[f"unit {k}"]:
            corner, move = moved(result, block)
            exact = np.zeros((len(corner), 3))
            exact[:, 0] = base + slope * (corner[:, 2] - level)
            assert np.abs(move - exact).max() < EXACT * total
        base, level = base + slope * height, level + height
