"""Two features of a limit analysis at once, each with its hand calculation."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import masonry
from geometry.joints.find import find_joints
from masonry.errors import SceneError
from masonry.statics.crushing import crushing_of
from masonry.statics.no_dilation import without_dilation
from masonry.statics.safety import factor_of_safety
from masonry.statics.solve import largest_factor
from tests.limit.blocks import CONES, PLANE, dry, stack
from tests.limit.one_block import SIDEWAYS, block
from tests.scenes import load

IN_BOTH = pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
WEIGHT, WIDTH, DEPTH, HEIGHT, AREA = 3000.0, 0.5, 0.3, 1.0, 0.15
"""Of the block of tests/limit/one_block.py: N, m, m2."""
GLUE = """law = "linear"
tensile_strength = "TENSION"
cohesion = "COHESION"
fracture_energy_mode_1 = "100 N/m"
fracture_energy_mode_2 = "1 kN/m"
"""
TILT = '[limit]\npattern = "tilt"\nabout = "y"\n'
PRESSED = '[[traction]]\non = "block.z+"\nstress = {z = "-8 kPa"}\n'
PUSHED = '[[traction]]\non = "block.x+"\nstress = {x = "-2 kPa"}\n'


def glued(more: str, tension: float, cohesion: float, **words) -> str:
    law = GLUE.replace("TENSION", f"{tension!r} Pa").replace("COHESION", f"{cohesion!r} Pa")
    return block(more, law, **words)


def angle(unbalanced: Callable[[float], float]) -> float:
    """The tangent of the first angle at which nothing is left."""
    return float(np.tan(brentq(unbalanced, 0.0, 1.5)))


def test_safety_with_tension_divides_the_moment_that_tension_bears():
    """It tips: 0.6 W h/2 = (W + f A / F) b/2. Friction, divided too, holds it all along."""
    by_hand = 10e3 * AREA * WIDTH / (0.6 * WEIGHT * HEIGHT - WEIGHT * WIDTH)
    assert by_hand == pytest.approx(2.5)
    sideways = '[limit]\npattern = "weight"\ndirection = "x"'
    result = masonry.limit(load(glued(sideways, 10e3, 100e3)), safety=True, at=0.6)
    assert result.factor == pytest.approx(by_hand, rel=1e-5)
    assert "no bound" in result.bound


@IN_BOTH
@pytest.mark.parametrize("dilation", [True, False])
def test_safety_of_what_slides_counts_cohesion_and_no_tension(method, dilation):
    """Pushed by 0.3 W: (mu W + c A) / 0.3 W; tension draws at one corner what presses at another one."""
    bodies, contacts = dry(stack([(2.0, 0.2)]), [0], 0.6, dead=(0.3, 0.0, -1.0))
    weight, area = 0.12, 0.6
    for tension, cohesion in ((0.5, 0.0), (0.0, 0.1), (0.5, 0.1)):
        strong = replace(contacts, tension=tension * contacts.area, cohesion=cohesion * contacts.area)
        by_hand = (0.6 * weight + cohesion * area) / (0.3 * weight)
        assert factor_of_safety(bodies, strong, method, dilation)[0] == pytest.approx(by_hand, rel=2e-4)


@pytest.mark.parametrize("steady", ["pressed", "pushed", "both"])
@pytest.mark.parametrize("tension", [0.0, 4e3])
def test_a_tilt_with_a_steady_load_that_does_not_turn(steady, tension):
    """W sin(t) h/2 + Q h/2 = (W cos(t) + P + f A) b/2: pressure on the top, push on the side, tension below."""
    pressed = 8e3 * AREA if steady != "pushed" else 0.0
    pushed = 2e3 * DEPTH * HEIGHT if steady != "pressed" else 0.0
    more = TILT + (PRESSED if pressed else "") + (PUSHED if pushed else "")
    scene = load(glued(more, tension, 100e3) if tension else block(more))

    def over(t: float) -> float:
        tips = (WEIGHT * np.sin(t) + pushed) * HEIGHT / 2
        return float(tips - (WEIGHT * np.cos(t) + pressed + tension * AREA) * WIDTH / 2)

    assert masonry.limit(scene).factor == pytest.approx(angle(over), rel=1e-7)


def test_safety_at_a_tilt_with_a_steady_load():
    """mu (W cos(t) + P) / (W sin(t)): a flat block that is pressed by 8 kPa on 0.6 m2."""
    t, weight, pressed = np.arctan(0.5), 2000 * 10 * 0.12, 8e3 * 0.6
    scene = load(block(TILT + PRESSED, size='["2 m", "0.3 m", "0.2 m"]'))
    by_hand = 0.7 * (weight * np.cos(t) + pressed) / (weight * np.sin(t))
    assert masonry.limit(scene, safety=True, at=0.5).factor == pytest.approx(by_hand, rel=1e-5)


def test_a_tilt_about_one_axis_of_a_weight_that_leans_along_it():
    """What of gravity is along the axis stays: a flat block slides askew, at sin(t)^2 + 0.6^2 = (mu cos(t))^2."""
    scene = load(block(TILT, size='["2 m", "0.3 m", "0.2 m"]').replace("[gravity]", '[gravity]\ny = "-6 m/s^2"'))
    by_hand = angle(lambda t: np.sin(t) ** 2 + 0.6**2 - (0.7 * np.cos(t)) ** 2)
    assert masonry.limit(scene).factor == pytest.approx(by_hand, rel=1e-6)


@pytest.mark.parametrize("about", ["x", "y", "z"])
@pytest.mark.parametrize("degrees", [-12.0, 15.0])
def test_a_turned_structure_pushed_off_its_middle_by_hand_in_the_axes_that_turned_with_it(about, degrees):
    """The block leans with its ground, gravity does not. A push at its top tips it about an edge of its base:
    moments about that edge, and for each edge the factor at which they change their sign."""
    turn = {"about": about, "angle": f"{degrees} deg", "through": ["0 m", "0 m", "0 m"]}
    matrix = Rotation.from_euler(about, degrees, degrees=True).as_matrix()
    at = matrix @ (WIDTH, DEPTH / 2, HEIGHT)
    push = np.array([700.0, 0.0, -400.0]) if about != "x" else np.array([0.0, 500.0, -300.0])
    more = '[limit]\npattern = "force"\non = "block"\nforce = {FORCE}\nat = [AT]\n'
    force = ", ".join(f'{k} = "{x!r} N"' for k, x in zip("xyz", push.tolist(), strict=True))
    place = ", ".join(f'"{x!r} m"' for x in at.tolist())
    text = block(more.replace("FORCE", force).replace("AT", place)).replace("= 0.7", "= 9.0")
    ground = '"-1 m", "0 m", "-1 m"], size = ["3 m", "0.3 m", "1 m"]'
    wide = text.replace(ground, '"-1 m", "-1 m", "-1 m"], size = ["3 m", "3 m", "1 m"]')
    factor = masonry.limit(load(wide).with_({"specimen.turned": turn})).factor
    corners = np.array([(0, 0, 0), (WIDTH, 0, 0), (WIDTH, DEPTH, 0), (0, DEPTH, 0)]) @ matrix.T
    middle = matrix @ (WIDTH / 2, DEPTH / 2, HEIGHT / 2)
    by_hand = []
    for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        edge = (other - one) / np.linalg.norm(
            other - one
        )  # counter-clockwise from above: what tips outwards is below 0
        stays = edge @ np.cross(middle - one, (0.0, 0.0, -WEIGHT))
        tips = edge @ np.cross(at - one, push)
        by_hand.append(-stays / tips if stays * tips < 0 else np.inf)
    assert factor == pytest.approx(min(by_hand), rel=1e-6) and factor < 10.0


@pytest.mark.parametrize("points", [2, 3, 5])
@IN_BOTH
def test_cohesion_and_tension_count_once_whatever_the_number_of_points(points, method):
    """A flat block slides at mu + c A / W; a tall one tips at (W + f A) b / (W h)."""
    flat, contacts = dry(stack([(2.0, 1.0)]), [0], 0.4, points=points)
    assert contacts.count == points**2
    glue = replace(contacts, cohesion=0.1 * contacts.area)
    assert largest_factor(flat, glue, method).factor == pytest.approx(0.4 + 0.1 * 0.6 / 0.6, rel=1e-6)
    assert without_dilation(flat, glue, method).solution.factor == pytest.approx(0.4 + 0.1 * 0.6 / 0.6, rel=1e-3)
    tall, contacts = dry(stack([(0.5, 1.0)]), [0], 5.0, points=points)
    glue = replace(contacts, tension=0.2 * contacts.area, cohesion=10.0 * contacts.area)
    assert largest_factor(tall, glue, method).factor == pytest.approx((0.15 + 0.2 * 0.15) * 0.5 / 0.15, rel=1e-6)


def test_cohesion_resists_a_turn_in_the_joint_the_better_known_the_more_points_there_are():
    """c times the integral of r over a square of side a, c a^3 (sqrt(2) + asinh(1)) / 6; corners bear 1.85 times it."""
    side, cohesion = 0.3, 2.0
    exact = cohesion * side**3 * (np.sqrt(2) + np.arcsinh(1.0)) / 6
    shares = {}
    for points in (2, 4, 9):
        bodies, contacts = dry(stack([(side, 0.4)]), [0], 0.0, points=points)
        live = np.zeros_like(bodies.live)
        live[1, 5] = 1.0
        glue = replace(contacts, cohesion=cohesion * contacts.area)
        shares[points] = largest_factor(replace(bodies, live=live), glue, CONES).factor / exact
    assert shares[2] == pytest.approx(6 / (np.sqrt(2) + np.arcsinh(1.0)) / np.sqrt(2), rel=1e-6)
    assert shares[2] > shares[4] > shares[9] and shares[9] == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize(("part", "word"), [(0.0, True), (0.5, True), (0.97, True), (1.0, False)])
def test_dilation_of_a_part_of_the_friction_angle_is_not_that_of_limit_analysis(part, word):
    """The factor is that of sliding, 0.7, whatever the dilation; the word on rising is absent where it is all of it."""
    law = 'law = "brittle"\ntensile_strength = "0 Pa"\ncohesion = "0 Pa"\ntan_residual_friction_angle = 0.7\n'
    rise = float(np.degrees(np.arctan(part * 0.7))) - 1e-9 * part
    law += f'dilation_cutoff = "0.1 m"\ndilation_angle = "{rise!r} deg"\n'
    flat = load(block("", law, '["2 m", "0.3 m", "0.2 m"]')).with_(SIDEWAYS)
    for words, by_hand in (({}, 0.7), ({"safety": True, "at": 0.35}, 2.0)):
        result = masonry.limit(flat, **words)
        assert result.factor == pytest.approx(by_hand, rel=1e-5)
        assert any("or rise less" in remark for remark in result.remarks) == word
        without = masonry.limit(flat, dilation=False, **words)
        assert without.factor == pytest.approx(by_hand, rel=1e-3) and without.bound.startswith("no bound")
        assert "without dilating" in without.assumed


def test_crushing_with_a_steady_load_and_a_tilt():
    """sin(t) W h/2 = N b/2 (1 - N / (fc A)) with N = W cos(t) + P."""
    strength = 60e3 * AREA

    def over(t: float) -> float:
        pressed = WEIGHT * np.cos(t) + 8e3 * AREA
        return float(WEIGHT * np.sin(t) * HEIGHT / 2 - pressed * WIDTH / 2 * (1 - pressed / strength))

    result = masonry.limit(load(block(TILT + PRESSED)), crushing="60 kPa")
    assert result.factor == pytest.approx(angle(over), rel=1e-6)


@pytest.mark.parametrize("degrees", [0.0, 30.0])
def test_crushing_in_a_turned_structure_pushed_at_its_top_square_to_a_side(degrees):
    """F h = W b/2 (1 - W / (fc A))."""
    matrix = Rotation.from_euler("z", degrees, degrees=True).as_matrix()
    at = ", ".join(f'"{x!r} m"' for x in (matrix @ (0.25, 0.15, 1.0)).tolist())
    push = (matrix @ (1e3, 0.0, 0.0)).tolist()
    force = f'{{x = "{push[0]!r} N", y = "{push[1]!r} N"}}'
    scene = load(block(f'[limit]\npattern = "force"\non = "block"\nforce = {force}\nat = [{at}]\n'))
    turned = (
        scene.with_({"specimen.turned": {"about": "z", "angle": f"{degrees} deg", "through": ["0 m", "0 m", "0 m"]}})
        if degrees
        else scene
    )
    by_hand = WEIGHT * WIDTH / 2 * (1 - WEIGHT / (40e3 * AREA)) / (1e3 * HEIGHT)
    assert masonry.limit(turned, crushing="40 kPa").factor == pytest.approx(by_hand, rel=1e-6)


@IN_BOTH
def test_crushing_with_cohesion_and_the_safety_of_both(method):
    """A flat block slides at mu + c A / W, far from being crushed; where it tips, strength of stone is not divided."""
    blocks = stack([(2.0, 1.0)])
    bodies, contacts = dry(blocks, [0], 0.4)
    crush = crushing_of(find_joints(blocks, "vertex", 2), 8.0, np.ones(contacts.count, dtype=bool))
    both = replace(contacts, cohesion=0.1 * contacts.area, crush=crush)
    assert largest_factor(bodies, both, method).factor == pytest.approx(0.4 + 0.1, rel=1e-5)
    at = replace(bodies, dead=bodies.dead + 0.25 * bodies.live)
    assert factor_of_safety(at, both, method)[0] == pytest.approx(2.0, rel=1e-5)


def test_crushing_with_tension_is_refused_and_without_strength_as_by_hand():
    sideways = '[limit]\npattern = "weight"\ndirection = "x"'
    scene = load(glued(sideways, 4e3, 100e3))
    with pytest.raises(SceneError, match="crushing= is for joints without tensile strength; add strength=False"):
        masonry.limit(scene, crushing="40 kPa")
    by_hand = WIDTH / HEIGHT * (1 - WEIGHT / (40e3 * AREA))
    assert masonry.limit(scene, crushing="40 kPa", strength=False).factor == pytest.approx(by_hand, rel=1e-7)
    cohesive = masonry.limit(load(glued(sideways, 0.0, 100e3)), crushing="40 kPa")
    assert cohesive.factor == pytest.approx(by_hand, rel=1e-6) and cohesive.bound.startswith("no bound")
