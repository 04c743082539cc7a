"""The interface model: it shares nothing with the solver, and it is what it says it is."""

import ast
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from verification.cases.fracture import wallette_of_two_courses
from verification.checks.paired_run import interface_model
from verification.references import closed_forms
from verification.references.interface import newton
from verification.references.interface.crushing import Compression, bears
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import grids
from verification.references.interface.model import InterfaceModel, model
from verification.references.interface.points import tangent, traction, unharmed
from verification.scene_runs import assembled

ROOT = Path(__file__).resolve().parents[2]
LAWS = ("linear", "polynomial", "exponential")
X = np.array([[1.0, 0.0, 0.0]])


def law(kind: str, **other) -> Law:
    numbers = {"kn": 150e9, "ks": 70e9, "fT": 0.58e6, "c0": 0.87e6, "tan0": 1.01, "tan_res": 0.73}
    return Law(kind, **{**numbers, "G_I": 5.8, "G_II": 58.0, "G_II_slope": 130e-6, "beta": 2.5, **other})


def imported(path: Path) -> set[str]:
    """Modules of this house that a file imports, anywhere in it."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            names |= {node.module or "", *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in (
            *("import_module", "__import__"),
        ):
            raise AssertionError(f"{path}: hidden import")
    return {name for name in names if name.split(".")[0] in ("geometry", "masonry", "verification", "tests")}


def test_the_interface_model_imports_nothing_of_the_solver_directly_or_through_others():
    waiting, seen = (
        [
            f"verification.references.interface.{p.stem}"
            for p in (ROOT / "verification/references/interface").glob("*.py")
        ],
        set(),
    )
    assert len(waiting) >= 6
    while waiting:
        name = waiting.pop()
        path = ROOT.joinpath(*name.split("."))
        path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
        if name in seen or not path.exists():
            continue
        seen.add(name)
        assert name.startswith("verification.references.interface") or name == "verification", (
            f"{name} is not of the model"
        )
        waiting += imported(path)


@pytest.mark.parametrize("kind", LAWS)
def test_a_point_follows_the_closed_forms_in_tension_and_in_shear_under_compression(kind):
    joint = closed_forms.Joint(beta=2.5)
    history, opening = unharmed(law(kind), 1), np.linspace(0.0, 60e-6, 121)
    for u in opening:
        t, history = traction(law(kind), history, X, u * X)
        assert t[0, 0] == pytest.approx(float(closed_forms.tension(kind, joint, u)), abs=1e-12 * joint.fT)
    history, pressed = unharmed(law(kind), 1), -0.5e6 / joint.kn
    for slip in np.linspace(0.0, 300e-6, 121):
        t, history = traction(law(kind), history, X, np.array([[pressed, 0.0, slip]]))
        assert t[0, 0] == pytest.approx(-0.5e6, rel=1e-14)
        assert t[0, 2] == pytest.approx(float(closed_forms.shear(kind, joint, slip, 0.5e6)), abs=1e-12 * joint.c0)


@pytest.mark.parametrize("kind", LAWS)
def test_unloading_is_along_the_secant_in_tension_and_by_ks_in_shear(kind):
    history = unharmed(law(kind), 1)
    top, history = traction(law(kind), history, X, 12e-6 * X)
    t, _ = traction(law(kind), history, X, 3e-6 * X)
    assert t == pytest.approx(0.25 * top, rel=1e-14)
    pressed = np.array([[-1e-6, 0.0, 0.0]])
    top, history = traction(law(kind), unharmed(law(kind), 1), X, pressed + [[0.0, 60e-6, 0.0]])
    t, _ = traction(law(kind), history, X, pressed + [[0.0, 58e-6, 0.0]])
    assert top[0, 1] - t[0, 1] == pytest.approx(70e9 * 2e-6, rel=1e-12)


def test_damage_of_one_mode_lowers_the_other_where_they_are_combined():
    for combined, left in ((True, np.exp(-2e-6 * 0.58e6 / 5.8)), (False, 1.0)):
        joint = law("exponential", combined=combined)
        torn = traction(joint, unharmed(joint, 1), X, (joint.opening_at_peak + 2e-6) * X)[1]
        t, _ = traction(joint, torn, X, np.array([[0.0, 1e-3, 0.0]]))
        slid = replace(torn, shear=np.ones(1))
        assert t[0, 1] < left * joint.c0
        tangential, _ = traction(joint, slid, X, np.array([[0.0, 0.99 * left * joint.c0 / joint.ks, 0.0]]))
        assert tangential[0, 1] == pytest.approx(0.99 * left * joint.c0, rel=1e-12)


CAP = Compression(10e6, 5e3, 0.09e-3, 9.0)


def pressed(joint: Law, closing: np.ndarray, slip: np.ndarray) -> np.ndarray:
    """(N, 2) Pa, compression and shear stress along a path of closing and slip (m)."""
    history, stress = unharmed(joint, 1), []
    for down, along in zip(closing, slip, strict=True):
        t, history = traction(joint, history, X, np.array([[-down, along, 0.0]]))
        stress.append((-t[0, 0], t[0, 1]))
    return np.array(stress)


def test_the_areas_under_the_strength_of_the_cap_are_those_of_the_closed_forms():
    """Hardening fm kp (1/3 + pi/6); softening above fm/10: G_c."""
    hardening = quad(lambda k: float(bears(CAP, k)), 0.0, CAP.kp, epsabs=1e-9)[0]
    softening = quad(lambda k: float(bears(CAP, k)) - 0.1 * CAP.fm, CAP.kp, 1e-2, epsabs=1e-9, points=[6.5e-4])[0]
    assert hardening == pytest.approx((1.0 / 3.0 + np.pi / 6.0) * CAP.fm * CAP.kp, rel=1e-9)
    assert softening == pytest.approx(CAP.G_c, rel=1e-9)


@pytest.mark.parametrize("ratio", [0.0, 0.2, 0.5, 1.0])
def test_a_proportional_path_meets_the_cap_where_it_should_and_flows_along_its_normal(ratio):
    """Closing p/kn + k cos a and slip r p/ks + k sin a with tan a = Css r keep the stresses at t = r p all the way."""
    joint = law("exponential", c0=100e6, compression=CAP)
    k = np.linspace(0.0, 4e-3, 200) ** 2 / 4e-3
    p = bears(CAP, k) / np.sqrt(1.0 + 9.0 * ratio**2)
    length = np.hypot(1.0, 9.0 * ratio)
    stress = pressed(joint, p / joint.kn + k / length, ratio * p / joint.ks + 9.0 * ratio * k / length)
    assert np.abs(stress[:, 0] - p).max() < 1e-9 * CAP.fm
    assert np.abs(stress[:, 1] - ratio * p).max() < 1e-9 * CAP.fm


def test_where_cap_and_coulomb_meet_both_hold_at_once():
    joint = law("exponential", c0=0.1e6, tan0=0.3, tan_res=0.3, compression=CAP)
    t = np.linspace(0.0, 1.0, 100)
    stress = pressed(joint, 3e-4 * t, 6e-4 * t**2)
    p, tau = stress.T
    both = (tau >= 0.3 * p * (1.0 - 1e-9)) & (p > 1e6) & (t > 0.5)
    assert both.sum() > 15
    assert np.hypot(p, 3.0 * tau).max() <= CAP.fm * (1.0 + 1e-9) and np.all(tau <= joint.c0 + 0.3 * p + 1.0)


def test_a_cut_off_falls_along_its_line_and_unloads_by_kn():
    joint = law("exponential", compression=Compression(10e6, 5e3))
    end = 2.0 * 5e3 / 10e6
    path = np.array([0.2e-3, 0.5 * end + 5e6 / joint.kn, 0.5 * end, 2.0 * end])
    p = pressed(joint, path, 0.0 * path)[:, 0]
    assert p[:2] == pytest.approx([10e6 * (1.0 - (path[0] - p[0] / joint.kn) / end), 5e6], rel=1e-9)
    assert p[2:] == pytest.approx([0.0, 0.0], abs=1e-3)


def test_the_tangent_is_the_derivative_while_softening_in_both_modes():
    joint, rng = law("exponential"), np.random.default_rng(1)
    normal = np.array([[0.6, 0.0, 0.8]])
    jump = np.array([[6e-6, 5e-6, 1e-5]])
    history = traction(joint, unharmed(joint, 1), normal, 0.9 * jump)[1]
    matrix = tangent(joint, history, normal, jump)[0]
    for _ in range(5):
        step = 1e-10 * rng.normal(size=3)
        change = traction(joint, history, normal, jump + step)[0] - traction(joint, history, normal, jump - step)[0]
        assert change[0] == pytest.approx(2.0 * matrix @ step, rel=1e-4, abs=1e-6 * np.abs(change).max())


def test_points_and_areas_are_those_of_the_contacts_of_a_run_on_the_same_tets():
    assembly = assembled(wallette_of_two_courses.SCENE)
    joint = interface_model(assembly).joints[0]
    ours = np.column_stack([joint.place, joint.weight, joint.normal, joint.blocks])
    given = assembly.model.joints
    theirs = np.column_stack([given.point, given.area, given.normal, given.block_a, given.block_b])
    ours, theirs = (a[np.lexsort(np.round(a, 9).T)] for a in (ours, theirs))
    assert len(ours) == len(theirs)
    assert np.abs(ours - theirs).max() < 1e-15


def stack(young: float, joint: Law) -> InterfaceModel:
    """Two cubes of 0.1 m one above the other."""
    one = np.linspace(0.0, 0.1, 3)
    wall = model(grids([(one, one, one), (one, one, one + 0.1)]), young, 0.0, lambda a, b: joint)
    wall.hold("xyz", lambda x, block: x[:, 2] < 1e-9)
    wall.drive("z", lambda x, block: x[:, 2] > 0.2 - 1e-9)
    return wall


def test_displacement_control_jumps_where_opening_control_follows_the_snap_back():
    joint = law("exponential")
    young = 0.3 * 0.2 * joint.fT**2 / joint.G_I
    bar = stack(young, joint)
    opening = bar.joints[0].jump.T @ (bar.joints[0].weight[:, None] * bar.joints[0].normal).ravel() / 0.01
    path = newton.EquilibriumPath(bar, opening)
    moved = []
    for s in np.linspace(0.0, 20e-6, 41)[1:]:
        path.go(float(s))
        stress = path.drive_force() / 0.01
        exact = float(closed_forms.tension("exponential", closed_forms.Joint(), s))
        assert stress == pytest.approx(exact, abs=1e-10 * joint.fT)
        moved.append(path.state.factor)
        assert moved[-1] == pytest.approx(s + exact * 0.2 / young, rel=1e-10)
    assert np.diff(moved).min() < 0.0


def test_what_holds_a_model_balances_what_is_driven_and_loaded():
    pulled = stack(5e9, law("exponential"))
    push = [3e3, 0.0, 0.0]
    pulled.dead = pulled.pressed(push, lambda x: x[0] > 0.1 - 1e-9)
    path = newton.EquilibriumPath(pulled)
    for k in range(1, 6):
        path.go(2e-6 * k, dead=min(1.0, 0.5 * k))
    held = path.reactions()
    assert np.abs(held[~pulled.held]).max() < 1e-9 * np.abs(held).max()
    for axis in range(3):
        assert held[pulled.axis == axis].sum() == pytest.approx(-push[axis] * 0.02, abs=1e-9 * np.abs(held).max())
