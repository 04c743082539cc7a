"""A cantilever of five blocks, its tip pushed down: rigid blocks with elastic joints, and tets.

    //|---+---+---+---+---|  | P       rigid blocks, joints at x_i, the glue at the wall among them:
    //|   |   |   |   |   |  v           d/P = sum over joints of [(L - x_i)^2/(kn I) + 1/(ks A)]
    //|---+---+---+---+---|            tets: P L^3/(3 E I) + P L/(kappa G A) besides (Timoshenko, kappa = 5/6)
       x_1 .............  L

P acts at the middle of a plate at the tip, of thickness t, which may turn: L is measured to its middle. Gauss points
give the joints' stiffness exactly from two on; points on the corners (vertex) are too stiff by a share that falls with
the square of their number. Constant-strain tets are too stiff in bending as well: another mesh is another model, and
only the meshes are held against the beam; the loading is, against the converged run on one of them (50 mm).
"""

from typing import Any

from verification.problem import ACCURACY, FEW_ROWS, Problem, Refinement, accuracies, dampings, fractions, steps
from verification.scene_runs import SceneRun

BLOCKS, SIDE, LENGTH, PLATE = 5, 0.1, 0.1, 0.02
KN, KS, YOUNG, POISSON, PUSH = 150e9, 70e9, 16.7e9, 0.2, 20e-6


SCENE = "cantilever"
STIFFNESS = "stiffness of the tip"
TETS: dict[str, Any] = {"kinematics": {"default": "tets", "plates": "rigid"}}


def measured(one: SceneRun) -> dict[str, float]:
    """Force over displacement at the tip (N/m)."""
    return {STIFFNESS: one.value("final") * SIDE**2 / PUSH}


def exact(one: SceneRun) -> dict[str, float]:
    """The same by beam theory; the blocks' own bending and shear only where they have any."""
    inertia, area, tip = SIDE**4 / 12, SIDE**2, BLOCKS * LENGTH + PLATE / 2
    arms = [tip - k * LENGTH for k in range(BLOCKS + 1)]
    give = sum(arm**2 / (KN * inertia) + 1 / (KS * area) for arm in arms)
    if "kinematics" in one.knobs:
        length, shear = BLOCKS * LENGTH, YOUNG / (2 * (1 + POISSON))
        give += (tip**3 - (tip - length) ** 3) / (3 * YOUNG * inertia) + length / (5 / 6 * shear * area)
    return {STIFFNESS: 1.0 / give}


def loading(fine: int, extra: dict[str, Any]) -> dict[str, Refinement]:
    """The knobs of an elastic test: nothing is spent, so that only the motion at the end counts."""
    usual = {"drive.steps": fine // 2}
    rates = steps(*(fine >> k for k in (4, 3, 2, 1, 0)))
    knobs = {"constant rate": rates, ACCURACY: accuracies()}
    knobs |= {"step fraction": fractions(usual), "damping": dampings(usual)}
    return {knob: {label: extra | keys for label, keys in settings.items()} for knob, settings in knobs.items()}


def points(kind: str) -> Refinement:
    """Contact points along each edge."""
    keys = {"specimen.contact_points": kind, "drive.steps": 16000}
    return {f"{n} x {n}": {**keys, "specimen.points_per_edge": n} for n in (2, 3, 4, 8)}


MESH = {f"{s} mm": {"specimen.mesh_size": f"{s} mm", "drive.steps": 8000} for s in (100, 50, 33, 25)}
RIGID = loading(32000, {}) | {"Gauss points": points("gauss"), "vertex points": points("vertex")}
PROBLEMS = (
    Problem(
        *("cantilever-rigid", "Cantilever of rigid blocks", SCENE, RIGID),
        base=FEW_ROWS,
        measure=measured,
        exact=exact,
        units={STIFFNESS: "N/m"},
    ),
    Problem(
        *("cantilever-tets", "Cantilever of tets", SCENE, loading(16000, {}) | {"model: mesh, against the beam": MESH}),
        base=TETS | FEW_ROWS,
        measure=measured,
        theory=exact,
        units={STIFFNESS: "N/m"},
        dear=True,
    ),
)
