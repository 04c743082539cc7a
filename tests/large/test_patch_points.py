"""Where the points of a patch lie: what a closed joint bends by, when the trust says that corners alone decide, and
what is lost with points that go."""

import numpy as np
import pytest

import masonry
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from tests.large.made import DENSITY, G, dry, leaning, slab
from tests.scenes import box, load

WORD = "three times as stiffly"


def leant(points: str, slope: float = 2.0, friction: float = 2.0) -> dict:
    """The summary of a block of 0.1 x 0.2 x 0.2 m that rests on a slope (deg), or slides on it."""
    boxes = [slab(), box("block", (-0.05, -0.1, 0.0), (0.1, 0.2, 0.2), "units", 1)]
    given = f'patch_points = "{points}"' if points else ""
    return laboratory.run(dry(boxes, friction, leaning(slope), 0.01, given, "", settle=40000)).summary


@pytest.mark.parametrize(("points", "stiffer"), [("", 3.0), ("corners", 3.0), ("spread", 1.0)])
def test_a_closed_joint_bends_as_its_pressure_does_only_with_points_inside(points, stiffer):
    """The moment of the weight about the middle of the face, over k_n times its second moment of area."""
    across, _, up = leaning(2.0)
    mass = DENSITY * 0.1 * 0.2 * 0.2
    summary = leant(points)
    tilt = mass * across * 0.1 / (stiffer * 1e10 * 0.2 * 0.1**3 / 12.0 + mass * up * 0.1)
    assert summary["rotation_max_rad"] == pytest.approx(tilt, rel=1e-3)
    assert (WORD in trust(summary)) == (points == "")


def test_a_block_that_topples_is_not_judged_by_its_closed_joint():
    assert WORD not in trust(leant("", slope=35.0))


def thrown(points: str, how: str):
    """A block that is thrown over a slab, or spun upon it."""
    boxes = [slab(2.0), box("block", (-0.1, -0.1, 0.0), (0.2, 0.2, 0.1), "units", 1)]
    given = f'patch_points = "{points}"' if points else ""
    return laboratory.run(dry(boxes, duration=0.3, turned=given, more=f'[[motion]]\non = "block"\n{how}\n'))


@pytest.mark.parametrize(("points", "lever"), [("", 2.0**0.5 / 2.0), ("spread", 0.3826)])
def test_a_block_that_turns_on_its_bed_is_slowed_by_its_points_and_trust_says_so(points, lever):
    """Corners have a lever of half the diagonal, an even pressure 0.3826 of the side."""
    side = 0.2
    result = thrown(points, 'spin = ["0 rad/s", "0 rad/s", "5 rad/s"]')
    rows, slowed = result.history.rows, 0.6 * G * lever * side / (side**2 / 6.0)
    energy = 0.5 * DENSITY * side**2 * 0.1 * side**2 / 6.0 * (5.0 - slowed * rows["time"]) ** 2
    early = (rows["time"] > 0.0) & (rows["time"] < 0.5 * 5.0 / slowed)
    assert early.sum() > 5
    assert rows["kinetic"][early] == pytest.approx(energy[early], abs=1e-2 * energy.max())
    assert ("turned on their beds" in result.trust) == (points == "")


def test_a_block_that_slides_straight_is_not_said_to_turn():
    assert "turned on" not in thrown("", 'velocity = ["1 m/s", "0.3 m/s", "0 m/s"]').trust


def turned_square(side: float, low: float, high: float, angle: float) -> tuple[np.ndarray, list[list[int]]]:
    """Corners and faces of a square slab, turned about its middle."""
    ring = (
        0.5
        * side
        * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        @ [
            [np.cos(angle), np.sin(angle)],
            [-np.sin(angle), np.cos(angle)],
        ]
    )
    corners = np.concatenate([np.insert(ring, 2, z, axis=1) for z in (low, high)])
    return corners, [[3, 2, 1, 0], [4, 5, 6, 7], *([i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4] for i in range(4))]


def off_a_turned_slab(folder, patch_points: str, step_fraction: float):
    """A square slides off another one that is turned against it, on soft shear springs: its patch loses points."""
    solids = [turned_square(0.4, -0.1, 0.0, 0.6), turned_square(0.4, 0.0, 0.1, 0.2)]
    path = masonry.write_blocks(folder / "two.blocks.h5", solids, names=["slab", "block"])
    return laboratory.run(
        load(f"""
displacements = "large"
law = "friction"
kinematics = "rigid"
[specimen]
kind = "file"
path = "{path}"
section = "1 m^2"
patch_points = "{patch_points}"
[material.units]
density = "2000 kg/m^3"
[contact.default]
normal_stiffness = "1e8 Pa/m"
shear_stiffness = "3e5 Pa/m"
tan_friction_angle = 0.6
normal_dashpot = 0.5
[[support]]
on = "slab"
fix = "all"
[[support]]
on = "block"
fix = ["y", "rotation"]
[gravity]
z = "-9.81 m/s^2"
[settle]
steps = 2000
[drive]
on = "block"
direction = "x"
displacement = "400 mm"
rate = "1 m/s"
ramp = 0.1
[solver]
masses = "real"
damping = 0
step_fraction = {step_fraction}
""")
    )


def test_a_patch_that_loses_points_loses_their_energy_once(tmp_path):
    """What corners and points inside hold is the same, and what is unaccounted for falls with the step."""
    one, two, shorter = (
        off_a_turned_slab(tmp_path, *how) for how in (("corners", 0.8), ("spread", 0.8), ("corners", 0.4))
    )
    lost = one.history.rows["redetection"][-1]
    assert lost > 0.5, "the springs that leave with the area hold this much"
    assert abs(one.history.rows["friction"][-1] - two.history.rows["friction"][-1]) < 1e-9 * lost
    open_by, half = one.summary["dissipation_mismatch"], shorter.summary["dissipation_mismatch"]
    assert half == pytest.approx(0.5 * open_by, rel=0.05)
