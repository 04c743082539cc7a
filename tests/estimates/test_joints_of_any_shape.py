"""Random joints in all six motions: what few contact points bear beside 40 x 40, and beside what is told of them.

What is right comes by other means: by halves, and by a search for the centre about which a joint turns.
"""

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import minimize

from geometry.joints.find import find_joints
from geometry.joints.point_density import Density
from geometry.polyhedra.construct import from_faces
from masonry.estimates.bearing_points import points_of
from masonry.estimates.joint_faces import faces_of
from masonry.estimates.joint_loads import JointWork, Look, Shear
from masonry.estimates.strength.joint_motions import bent, slid
from masonry.laws.friction import Friction
from masonry.laws.linear import Linear
from masonry.laws.state import JointProperties

KN, KS, STRONG, TOUGH, CRUSHES, RUBS = 20e9, 8e9, 0.2e6, 1e9, 5e6, 0.6
NEAR = 0.015
"""Of what is borne: errors beyond are told."""
TURN, TURNS = 1e-2, {"glued": np.geomspace(1e-7, 1e-2, 40)}
"""rad, of a joint that is glued; those that are tried, of others till they turn about their very edge."""
MANY = Density("gauss", 40)


class Case(NamedTuple):
    """A prism on another one: the convex polygons (K, 2) m of their joint, its points, and its law."""

    pieces: list[np.ndarray]
    rule: str
    number: int
    law: str

    @property
    def corners(self) -> np.ndarray:
        """(K, 2) m."""
        return np.concatenate(self.pieces)


def polygons(random: np.random.Generator) -> list[np.ndarray]:
    """A rectangle of 1:1 to 1:10, a triangle, or an L in two pieces, turned."""
    length, kind = random.uniform(0.2, 1.0), random.random()
    if kind < 0.4:
        width = length / random.uniform(1.0, 10.0)
        flat = [np.array([[0.0, 0.0], [length, 0.0], [length, width], [0.0, width]])]
    elif kind < 0.6:
        flat = [np.array([[0.0, 0.0], [length, 0.1 * length], [random.uniform(0.1, 0.9) * length, 0.6 * length]])]
    else:
        high, thick, wide = length * np.array([random.uniform(0.3, 1.0), *random.uniform(0.1, 0.25, 2)])
        flat = ells(length, high, thick, wide, random.random() < 0.5)
    angle = random.uniform(0.0, 2.0 * np.pi)
    return [one @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]) for one in flat]


def ells(long: float, high: float, thick: float, wide: float, mitred: bool) -> list[np.ndarray]:
    """An L, cut along an arm or from corner to corner."""
    outer, inner = [0.0, 0.0], [wide, thick]
    if mitred:
        return [
            np.array([outer, [long, 0.0], [long, thick], inner]),
            np.array([outer, inner, [wide, high], [0.0, high]]),
        ]
    return [
        np.array([outer, [long, 0.0], [long, thick], [0.0, thick]]),
        np.array([[0.0, thick], inner, [wide, high], [0.0, high]]),
    ]


def cases(count: int) -> list[Case]:
    random = np.random.default_rng(56)
    laws = ["elastic", "dry", "glued", "crushing"]
    return [
        Case(polygons(random), ["gauss", "vertex"][k // 4 % 2], int(random.integers(2, 13)), laws[k % 4])
        for k in range(count)
    ]


PROPERTIES = {
    "elastic": (None, JointProperties(KN, KS)),
    "dry": (Friction(), JointProperties(KN, KS, tensile_strength=0.0, cohesion=0.0, tan_friction=RUBS)),
    "glued": (
        Linear(TOUGH, TOUGH),
        JointProperties(KN, KS, tensile_strength=STRONG, cohesion=STRONG, tan_friction=0.0, residual_cohesion=0.0),
    ),
    "crushing": (
        Friction(),
        JointProperties(KN, KS, tensile_strength=0.0, cohesion=0.0, tan_friction=RUBS, compressive_strength=CRUSHES),
    ),
}


def prism(pieces: list[np.ndarray], low: float, high: float) -> list[np.ndarray]:
    """Faces of a prism on polygons: no sides between two of them."""
    faces = []
    for flat in pieces:
        bottom, top = (np.column_stack([flat, np.full(len(flat), z)]) for z in (low, high))
        others = [other for other in pieces if other is not flat]
        faces += [bottom[::-1], top]
        for k in range(len(flat)):
            middle = 0.5 * (flat[k - 1] + flat[k])
            if not any(is_inside(other, middle) for other in others):
                faces.append(np.array([bottom[k - 1], bottom[k], top[k], top[k - 1]]))
    return faces


def is_inside(flat: np.ndarray, point: np.ndarray) -> bool:
    """Whether a polygon has a point within it, or at its edge."""
    edge, off = np.roll(flat, -1, axis=0) - flat, point - flat
    return bool((edge[:, 0] * off[:, 1] - edge[:, 1] * off[:, 0] > -1e-12).all())


class Joint:
    """A case as the estimates see it."""

    def __init__(self, case: Case) -> None:
        solids = [prism(case.pieces, -0.1, 0.0), prism(case.pieces, 0.0, 0.1)]
        joints = find_joints(from_faces(solids, [0, 1], [0, 0], ["g"]), case.rule, case.number)
        count = len(joints.area)
        parameters, properties = PROPERTIES[case.law]
        model = SimpleNamespace(
            group=np.zeros(count, dtype=int),
            groups=Groups((parameters,), (properties,), [0, count]),
            group_names=("joint",),
        )
        self.assembly = SimpleNamespace(joints=joints, model=model, scene=SimpleNamespace(is_large=False), pairs=None)
        self.case, self.joints = case, joints
        self.faces = faces_of(self.assembly)
        self.middle, self.normal = self.faces.middle[0], self.faces.normal[0]
        (self.area,) = self.faces.area.tolist()
        solid = [np.column_stack([flat, np.zeros(len(flat))]) for flat in case.pieces]
        point, area = points_of(solid, MANY)
        self.own = joints.point - self.middle, joints.area
        self.many = point - self.middle, area

    def look(self, **given) -> Look:
        zeros = {"force": np.zeros(1), "torn": np.zeros(1, dtype=bool)}
        zeros |= {name: JointWork(np.zeros(1), np.zeros(1)) for name in ("work", "inelastic")}
        zeros |= {"moment": np.zeros((1, 3)), "turn": np.zeros((1, 3))}
        return Look(**(zeros | given))


class Groups(NamedTuple):
    parameters: tuple
    properties: tuple
    bounds: list


def stress(law: str, opening: np.ndarray) -> np.ndarray:
    """Pa, of laws that do not soften."""
    pull = {"dry": 0.0, "crushing": 0.0, "glued": STRONG}.get(law, np.inf)
    return np.clip(KN * opening, -CRUSHES if law == "crushing" else -np.inf, pull)


def moment_by_halves(law: str, place: np.ndarray, area: np.ndarray, force: float) -> float:
    """N m: the largest of all turns, of plane sections that carry a normal force."""
    most = 0.0
    for turn in TURNS.get(law, np.geomspace(1e-7, 1e7, 60)):
        low, high = -1.0 - 2.0 * turn, 1.0 + 2.0 * turn
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if area @ stress(law, middle + turn * place) < force else (low, middle)
        bears = stress(law, low + turn * place) * area, stress(law, high + turn * place) * area
        share = (force - bears[0].sum()) / max(bears[1].sum() - bears[0].sum(), 1e-30)
        most = max(most, float((bears[0] + np.clip(share, 0.0, 1.0) * (bears[1] - bears[0])) @ place))
    return most


def slide_by_search(place: np.ndarray, bears: np.ndarray, load: np.ndarray) -> float:
    """The multiple of two shears (N) and a twist (N m) that points bear with strengths (N): the least that friction
    takes for a unit of work, of all ways to slide and turn."""
    size = np.sqrt((place**2).sum(axis=1).mean())
    one = load / np.array([1.0, 1.0, size])
    one_long = one / np.linalg.norm(one)
    across = np.linalg.svd(one_long[None])[2][1:]

    def takes(amounts: np.ndarray) -> float:
        u, v, turn = (one_long + amounts @ across) / np.array([1.0, 1.0, size])
        return float(bears @ np.hypot(u - turn * place[:, 1], v + turn * place[:, 0]))

    least = [minimize(takes, start, method="Nelder-Mead", options={"xatol": 1e-7, "fatol": 1e-9}).fun
             for start in (np.zeros(2), np.array([1.0, -0.7]))]  # fmt: skip
    return min(least) / float(np.linalg.norm(one))


CASES = cases(60)
NAMES = [f"{case.law}, {case.number} {case.rule}, {len(case.corners)} corners" for case in CASES]
OF_STRENGTH = [(case, name) for case, name in zip(CASES, NAMES, strict=True) if case.law != "elastic"]


def said_and_right(said: float, right: float) -> bool:
    """Whether an error of what is borne is told as it is, or both are small."""
    return abs(said - right) < NEAR * max(1.0, right)


@pytest.mark.parametrize("case", [case for case, _ in OF_STRENGTH], ids=[name for _, name in OF_STRENGTH])
def test_what_few_points_bear_in_bending_is_told(case: Case) -> None:
    joint, random = Joint(case), np.random.default_rng(len(case.corners) * case.number)
    force = 0.0 if case.law == "glued" else -random.uniform(0.05, 0.4) * CRUSHES * joint.area
    for angle in random.uniform(0.0, 2.0 * np.pi, 2):
        along = np.array([np.cos(angle), np.sin(angle), 0.0])
        own, many = (moment_by_halves(case.law, p @ along, a, force) for p, a in (joint.own, joint.many))
        if case.law == "dry":  # no points reach the corners that it turns about
            many = force * min((case.corners - joint.middle[:2]) @ along[:2])
        look = joint.look(force=np.array([force]), moment=own * along[None], turn=1e-4 * along[None])
        one = bent(joint.assembly, joint.faces, look, 0, True, (TURN, np.inf), np.ones(2))
        assert said_and_right(one.by(joint.joints.point, joint.joints.area), own / many), own / many
        assert said_and_right(one.carries, own / many)


@pytest.mark.parametrize("case", [case for case, _ in OF_STRENGTH], ids=[name for _, name in OF_STRENGTH])
def test_what_few_points_bear_of_two_shears_and_a_twist_is_told(case: Case) -> None:
    joint, random = Joint(case), np.random.default_rng(len(case.corners) * case.number)
    force = 0.0 if case.law == "glued" else -0.1 * CRUSHES * joint.area
    size = np.sqrt(joint.area)
    moment = force * np.array([*random.uniform(-0.05, 0.05, 2), 0.0]) * size
    for shears, twist in (((0.0, 0.0), 1.0), (random.uniform(-2.0, 2.0, 2), 1.0)):
        load = np.array([*shears, twist * size])
        bears = []
        for place, area in (joint.own, joint.many):
            rows = np.column_stack([np.ones(len(area)), place[:, :2]])
            pressed = -rows @ np.linalg.solve((rows.T * area) @ rows, [force, *moment[:2]])
            strong = STRONG if case.law == "glued" else RUBS * pressed
            bears.append(slide_by_search(place[:, :2], strong * area, load))
        own, many = bears
        across = np.array([load[0], load[1], 0.0]) * own
        turned = joint.normal[2] * load[2] * own
        shear = Shear(across[None], np.array([turned]), np.zeros(1))
        work = JointWork(np.zeros(1), np.ones(1))
        look = joint.look(force=np.array([force]), moment=moment[None], work=work, inelastic=work)
        slips = SimpleNamespace(
            damage_tension=np.zeros(len(joint.joints.area)), slip=np.full(len(joint.joints.area), 0.01)
        )
        one = slid(joint.assembly, joint.faces, look, shear, slips, 0, np.ones(2))
        assert said_and_right(one.by(joint.joints.point, joint.joints.area), own / many), (shears, own / many)
        assert said_and_right(one.carries, own / many)


@pytest.mark.parametrize("case", CASES, ids=NAMES)
def test_how_much_too_stiffly_few_points_bend_and_twist_is_told(case: Case) -> None:
    """A stress that is even is borne alike, as areas and first moments are those of the polygon."""
    joint = Joint(case)
    own, many = (np.einsum("c,ci,cj->ij", a, p, p)[:2, :2] for p, a in (joint.own, joint.many))
    assert joint.own[1].sum() == pytest.approx(joint.many[1].sum()) and np.allclose(joint.own[1] @ joint.own[0], 0.0)
    bends = (np.linalg.inv(many) - np.linalg.inv(own)) / KN
    twists = (1.0 / np.trace(many) - 1.0 / np.trace(own)) / KS
    scale = 1.0 / (KS * np.trace(many))
    assert joint.faces.softness[0, :2, :2] == pytest.approx(bends, abs=1e-6 * np.linalg.inv(many).max() / KN)
    assert joint.faces.softness[0, 2, 2] == pytest.approx(twists, abs=1e-6 * scale)
    assert (case.rule, case.number) == ("vertex", 2) or abs(twists) < NEAR * scale, "two points at the edges alone"


@pytest.mark.parametrize("law", ["dry", "crushing", "glued"])
def test_a_joint_that_closes_evenly_but_for_rounding_does_not_bend(law):
    joint = Joint(next(case for case in CASES if case.law == law))
    closes = 1e6 / KN
    look = joint.look(force=np.array([-1e6 * joint.area]), turn=np.array([[1e-12, 0.0, 0.0]]))
    turns = np.array([1e-4, 1e-2]) * closes / np.ptp(joint.case.corners[:, 0])
    few, some = (bent(joint.assembly, joint.faces, look, 0, True, (turn, np.inf), np.ones(2)) for turn in turns)
    assert few is None and some is not None
