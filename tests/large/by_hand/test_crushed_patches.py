"""Patches that crush: a joint that rocks, by closed forms; what faces remember of it as they part, slide and turn."""

from functools import cache

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.configuration import configuration_of
from masonry.configuration.model_state import restore, state
from masonry.elements.joints import cells_of_joints as cells
from masonry.elements.joints.cells_of_joints import cells_of_joints
from masonry.laws.compression_cap import strength_left
from masonry.laws.state import JointProperties
from masonry.model.model import Model
from masonry.patches.arrays import AREA, CRUSHED, FRICTION
from masonry.patches.crushed_points import CLOSING, HARDENING
from masonry.patches.refreshing import refresh
from tests.kinematics.bricks import turn
from tests.large.by_hand.patch_calls import press, stored_energy
from tests.large.made import dry, slab
from tests.scenes import box

LENGTH, DEPTH, HEIGHT, KN, STRENGTH, DT = 0.8, 0.2, 0.5, 10e9, 5e6, 1e-7
FORCE = 0.2 * LENGTH * DEPTH * STRENGTH
CENTRE = np.array([0.0, 0.0, 0.5 * HEIGHT])
FAR = np.array([3e3, -7e3, 5e2])
ASKEW = turn(0, 0.7) @ turn(2, -2.0) @ turn(1, 1.1)


CUT_OFF = 'crushing = "cut-off"'
CAP = 'crushing = "cap"\nfracture_energy_compression = "20 N/mm"\nclosing_at_peak = "0.3 mm"'


@cache
def begun(along: int | None = None, law: str = CUT_OFF) -> tuple[Model, dict]:
    boxes = [slab(4.0), box("block", (-0.5 * LENGTH, -0.5 * DEPTH, 0.0), (LENGTH, DEPTH, HEIGHT), "units", 1)]
    joint = f'compressive_strength = "{STRENGTH!r} Pa"\n{law}'
    model = assemble(dry(boxes, joint=joint, turned=f"patch_points_per_edge = {along}" if along else "")).model
    return model, state(model)


class Joint:
    """A block on a slab, which is placed by hand; both seen from a slab that is turned and far away."""

    def __init__(self, along=None, way=np.eye(3), origin=np.zeros(3), law=CUT_OFF) -> None:  # noqa: B008
        self.model, untouched = begun(along, law)
        restore(self.model, untouched)
        self.way, self.origin, self.slid = way, origin, 0.0
        self.place(0.0, 0.0)
        self.look()

    def look(self) -> None:
        """At all pairs that moved; nothing damps."""
        assert refresh(self.near) >= 0.0
        self.near.pairs.dashpot[:] = 0.0

    @property
    def near(self):
        return self.model.large.near

    @property
    def closings(self) -> np.ndarray:
        """(K,) m, by place along x and rounds."""
        s = self.near.pairs.slot[0]
        return self.near.points.crushed[s, :, CLOSING].ravel()[: self.near.points.number[s]]

    @property
    def areas(self) -> np.ndarray:
        """(K,) m2."""
        s = self.near.pairs.slot[0]
        return self.near.points.quads[:, s, AREA].ravel()[: self.near.points.number[s]]

    @property
    def crushing(self) -> float:
        return float(self.near.account[CRUSHED])

    def place(self, angle: float, down: float, slid: float = 0.0) -> None:
        """Turn the block about the middle of its base, push it down (m) and along x."""
        rigid, slab_centre = self.model.bodies.rigid, self.model.layout.centroid[0]
        own = turn(1, angle)
        for b, (frame, place) in enumerate([(np.eye(3), slab_centre), (own, own @ CENTRE + [slid, 0.0, -down])]):
            now = self.way @ place + self.origin - self.model.layout.centroid[b]
            self.near.motion.travel[b] += np.linalg.norm(now - rigid.q[b, :3]) + 0.5 * abs(angle)
            rigid.q[b, :3], rigid.frame[b] = now, self.way @ frame
        self.slid = slid

    def press(self, angle: float, down: float, slid: float = 0.0) -> tuple[float, float]:
        """Normal force (N), and its moment about the middle of the base (N m), towards where the block turns back."""
        before = self.model.bodies.rigid.q[1, :3].copy()
        self.place(angle, down, slid)
        near = self.near
        near.motion.v[:] = 0.0
        up = self.way[:, 2]
        near.motion.v[1, :3] = ((self.model.bodies.rigid.q[1, :3] - before) @ up / DT) * up
        press(near, DT)
        force, moment = self.way.T @ near.motion.push[1, :3], self.way.T @ near.motion.push[1, 3:6]
        arm = turn(1, angle) @ CENTRE
        return float(force[2]), -float(moment[1] + arm[2] * force[0] - arm[0] * force[2])

    def lowered(self, angle: float, down: float) -> tuple[float, float]:
        """How far down (m) it is once it bears FORCE, from `down` on, in steps that do not crush it by more; its
        moment."""
        step, force, moment = FORCE / (KN * LENGTH * DEPTH) / 200.0, 0.0, 0.0
        while force < FORCE:
            down += step * float(np.clip(100.0 * (1.0 - force / FORCE), 0.05, 50.0))
            force, moment = self.press(angle, down)
        return down, moment * FORCE / force


def closed_form(angle: float) -> float:
    """N m under FORCE: without tension, cut off in compression."""
    touches = np.sqrt(2.0 * FORCE / (KN * DEPTH * angle))
    if touches > LENGTH:
        return KN * DEPTH * LENGTH**3 / 12.0 * angle
    if KN * angle * touches < STRENGTH:
        return FORCE * (0.5 * LENGTH - touches / 3.0)
    elastic = STRENGTH / (KN * angle)
    plastic = FORCE / (DEPTH * STRENGTH) - 0.5 * elastic
    return FORCE * 0.5 * LENGTH - DEPTH * STRENGTH * (0.5 * plastic**2 + 0.5 * elastic * (plastic + elastic / 3.0))


def rocked(joint: Joint, angles: np.ndarray) -> tuple[float, np.ndarray]:
    """The moments (N m) at angles that grow, each reached from above; and how far down it is then."""
    down, moments = 0.0, []
    for angle in angles:
        down, moment = joint.lowered(angle, down - 0.55 * LENGTH * angle)
        moments.append(moment)
    return down, np.array(moments)


ANGLES = 2.0 * FORCE / (KN * DEPTH * LENGTH**2) * np.geomspace(0.2, 60.0, 10)
LIMIT = FORCE * 0.5 * LENGTH * (1.0 - FORCE / (LENGTH * DEPTH * STRENGTH))


@pytest.mark.parametrize(("along", "off"), [(None, 1e-2), (20, 4e-3)])
def test_the_moment_of_a_rocking_joint_is_that_of_the_closed_form(along, off):
    _, moments = rocked(Joint(along), ANGLES)
    assert moments == pytest.approx([closed_form(angle) for angle in ANGLES], rel=off)
    assert moments[-1] == pytest.approx(LIMIT, rel=5e-3)


def test_far_away_and_turned_it_is_the_same():
    (one, closings), (other, elsewhere) = (
        (rocked(joint, ANGLES[::3])[1], joint.closings.copy())
        for joint in map(lambda given: Joint(**given), ({}, {"way": ASKEW, "origin": FAR}))
    )
    assert other == pytest.approx(one, rel=1e-5)
    assert elsewhere == pytest.approx(closings, abs=1e-5 * closings.max())


def test_nothing_heals_on_the_way_back_and_the_second_time_it_goes_along_the_crushed_profile():
    joint = Joint()
    down, (most,) = rocked(joint, ANGLES[7:8])
    crushed, spent = joint.closings.copy(), joint.crushing
    less = ANGLES[4]
    _, softer = joint.lowered(less, -LENGTH * less)
    assert softer < 0.8 * closed_form(less), "a crushed toe is round"
    assert np.array_equal(joint.closings, crushed) and joint.crushing == spent
    again, moment = joint.lowered(ANGLES[7], down - 1e-4)
    assert moment == pytest.approx(most, rel=1e-3)
    assert joint.crushing == pytest.approx(spent, rel=1e-3), "no more than the last step"
    _, other_way = joint.lowered(-ANGLES[7], -LENGTH * ANGLES[7])
    assert -other_way == pytest.approx(most, rel=1e-2), "the other toe is whole"
    assert joint.crushing == pytest.approx(2.0 * spent, rel=1e-2)


def test_work_into_the_joint_is_what_it_stores_and_what_crushing_took():
    joint = Joint()
    angle, work, before, last = ANGLES[6], 0.0, 0.0, None
    for down in np.linspace(-0.5 * LENGTH * angle, 0.0, 2001):
        force, _ = joint.press(angle, down)
        if last is not None:
            work += 0.5 * (force + before) * (down - last)
        before, last = force, down
    assert joint.crushing > 0.3 * work
    assert stored_energy(joint.near) + joint.crushing == pytest.approx(work, rel=1e-6)


def test_what_was_crushed_is_still_so_after_the_block_was_far_away_and_came_back():
    joint = Joint()
    down, _ = rocked(joint, ANGLES[7:8])
    force, moment = joint.press(ANGLES[7], down)
    crushed = joint.closings.copy()
    for height in (0.0, 1.0, 0.0):
        joint.place(ANGLES[7], down - height)
        joint.look()
        assert (joint.near.pairs.number[0] == 0 or joint.near.pairs.slot[0] < 0) == (height > 0.0)
    assert joint.closings[4:] == pytest.approx(crushed[4:], abs=1e-12), "but for the edge, thinner than a cell"
    joint.near.pairs.slack[:] = 0.0
    back = joint.press(ANGLES[7], down)
    assert back == pytest.approx((force, moment), rel=2e-2)


def test_a_cap_hardens_and_softens_and_holds_back_shear_with_pressure():
    """sigma^2 + 9 tau^2 = (strength left)^2, wherever it is crushed on; and the work adds up."""
    joint, area, speed = Joint(law=CAP), LENGTH * DEPTH, 1e-7 / DT
    near, work, before = joint.near, 0.0, np.zeros(3)
    properties = JointProperties(KN, 0.5 * KN, compressive_strength=STRENGTH, crushing_energy=20e3,
                                 closing_at_peak=3e-4, cap_shear_factor=9.0)  # fmt: skip
    for step in range(20000):
        joint.place(0.0, 1e-7 * (step + 1))
        way = np.array([0.3 if step < 10000 else 0.0, 0.0, -1.0])
        near.motion.v[1, :3] = speed * way
        press(near, DT)
        force = near.motion.push[1, :3].copy()
        work, before = work - 0.5 * (force + before) @ way * 1e-7, force
        if step % 500 == 499:
            s = near.pairs.slot[0]
            left = strength_left(properties, near.points.crushed[s, 0, HARDENING, 0])
            assert np.hypot(force[2], 3.0 * force[0]) <= (1.0 + 1e-9) * area * left
            if joint.crushing > 0.0:
                assert np.hypot(force[2], 3.0 * force[0]) == pytest.approx(area * left, rel=1e-6)
    known = stored_energy(near) + joint.crushing + near.account[FRICTION]
    assert known == pytest.approx(work, rel=1e-3)
    assert joint.crushing > 0.5 * work


def test_a_frame_shows_what_the_patches_crushed_where_the_joint_was():
    """What a block pressed askew closes by, along a line from its toe, before and after its faces know of it."""
    joint = Joint(20, ASKEW, FAR)
    joint.model.large.bonds.alive[:] = False
    joint.place(ANGLES[-1], 0.0)
    down, _ = rocked(joint, ANGLES[-1:])
    contacts, x = joint.model.joints, joint.model.joints.point[:, 0]
    by_hand = np.maximum(down + np.sin(ANGLES[-1]) * x - STRENGTH / KN, 0.0)
    untold = configuration_of(joint.model).crushing.closing()
    joint.place(ANGLES[-1], -1.0)
    joint.look()
    told = configuration_of(joint.model).crushing.closing()
    ring = 0.1 * LENGTH * np.sin(ANGLES[-1])
    for closing in (untold, told):
        assert closing.shape == contacts.area.shape and closing.max() > 0.5 * by_hand.max()
        assert closing == pytest.approx(by_hand, abs=2.0 * ring)
        assert not closing[x < 0.0].any()


def test_cells_of_joints_are_the_same_looked_at_in_parts(monkeypatch):
    joint = Joint()
    joints = joint.model.joints
    whole = cells_of_joints(joints, joint.near)
    monkeypatch.setattr(cells, "AT_ONCE", 7)
    assert len(cells.in_parts(np.full(len(joints.area), 6))) > 1
    assert np.array_equal(cells_of_joints(joints, joint.near), whole) and np.all(whole >= 0)


def test_faces_beside_a_mesh_have_cells_of_their_own_size():
    boxes = [slab(4.0), box("block", (-0.5 * LENGTH, -0.5 * DEPTH, 0.0), (LENGTH, DEPTH, HEIGHT), "meshed", 1)]
    joint = f'compressive_strength = "{STRENGTH!r} Pa"\n{CUT_OFF}'
    scene = dry(boxes, joint=joint).with_(
        {
            **{f"contact.default.{kind}_stiffness": "10 GPa/m" for kind in ("normal", "shear")},
            **{"contact.default.tan_friction_angle": 0.6, "contact.default.crushing": "cut-off"},
            "contact.default.compressive_strength": "5 MPa",
            "kinematics": {"default": "rigid", "meshed": "tets"},
            "specimen.mesh_size": "0.4 m",
            "material.meshed": {"density": "2000 kg/m^3", "young_modulus": "5 GPa", "poisson_ratio": 0.2},
        }
    )
    near = assemble(scene).model.large.near
    number = near.crushed.number[np.isclose(near.pieces.normal[:, 2], 1.0) & (near.pieces.normal[:, 0] == 0.0)]
    assert number[0].tolist() == [138, 35], "of 29 mm, a twentieth of the size of most blocks"
    assert np.all(near.crushed.number[6:] == 4), "of triangles"


def slide(joint: Joint, start: float, end: float) -> None:
    """Move the block along the ground, with as many looks as a run takes."""
    for x in np.linspace(start, end, 200):
        joint.place(0.0, 2e-3, x)
        joint.look()


def test_half_of_it_goes_along_with_the_block_and_half_stays_on_the_ground():
    joint = Joint()
    for down in np.linspace(0.0, 2e-3, 200):
        joint.press(0.0, down)
    assert joint.closings == pytest.approx(np.full(20, 2e-3 - STRENGTH / KN), rel=1e-6)
    whole = joint.closings[0]
    share, blocks = configuration_of(joint.model).crushing.in_patches(np.array([0.1, DEPTH]))
    assert (share, sorted(blocks)) == (pytest.approx(whole / 0.1), [0, 1])
    slide(joint, 0.0, 0.5 * LENGTH)
    s = joint.near.pairs.slot[0]
    x = joint.near.points.quads[:, s, 0].ravel()[: joint.near.points.number[s]]  # from the block's centroid
    expected = np.where(x < 0.0, whole, 0.5 * whole)
    assert joint.areas @ joint.closings == pytest.approx(joint.areas @ expected, rel=0.03), "within a cell"
    slide(joint, 0.5 * LENGTH, 1.5 * LENGTH)
    assert joint.closings == pytest.approx(0.5 * whole, abs=1e-9), "ground that is new, and the block's own half"


def test_it_softens_by_its_energy():
    energy = 2.0 * STRENGTH**2 / (2.0 * KN)
    joint = Joint(law=f'{CUT_OFF}\nfracture_energy_compression = "{energy!r} N/m"')
    end = 2.0 * energy / STRENGTH
    forces = np.array([joint.press(0.0, down)[0] for down in np.linspace(0.0, 1.2 * end, 400)])
    assert forces.max() == pytest.approx(STRENGTH * LENGTH * DEPTH, rel=1e-2)
    assert forces[-1] == pytest.approx(0.0, abs=1e-6 * forces.max())
    assert joint.crushing == pytest.approx(energy * LENGTH * DEPTH, rel=1e-3)
