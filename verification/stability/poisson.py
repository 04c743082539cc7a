"""Poisson's ratio towards one half, where constant-strain tets lock in bending but not in uniform strain."""

from verification import timed_run
from verification.scene_runs import SceneRun
from verification.stability.cells import Compare, Exact, Grid, MapCell
from verification.stability.scenes import CHAIN, Knobs, chain_of, pascals

YOUNG, EDGE, PUSH, STIFF = 16.7e9, 0.1, 1e-6, 1e15
"""Pa; m; m of the drive; Pa/m of the joints, so stiff that next to nothing gives way but the block between them."""
COMMON: Knobs = {
    "law": "elastic",
    "kinematics": "tets",
    "gravity": {"z": "-1e-9 m/s^2"},
    "drive.accuracy": "1 %",
    "drive.displacement": f"{PUSH!r} m",
    "solver.rows": 100,
}
FACES = [{"on": f"b1.{axis}{side}", "fix": axis} for axis in "xy" for side in "-+"]
ENDS = [{"on": "end", "fix": "all"}, {"on": "top", "fix": ["x", "y"]}]
TALL = 0.4


def ratios(full: bool) -> Grid:
    """Three loadings."""
    values = (0.0, 0.2, 0.3, 0.35, 0.4, 0.45, 0.49, 0.499, 0.4999) if full else ()
    cells = {}
    for name, (knobs, compare) in LOADINGS.items():
        for ratio in values:
            must = ("WARNED",) if ratio >= 0.45 else ()
            cells[name, f"{ratio:g}"] = MapCell(CHAIN, {**knobs, "material.units.poisson_ratio": ratio}, compare, must)
    note = (
        "Above 0.3 the program warns that such tets lock. In uniform strain they do not; in bending (blocks held "
        "against turning, 25 mm mesh) the stiffness is held against that at 0 with the theory's change by the shear."
    )
    return Grid("Poisson's ratio of tets", "loading", "Poisson's ratio", cells, "closed form; at 0 in bending", note)


def _ratio(one: SceneRun) -> float:
    return float(one.knobs["material.units.poisson_ratio"])


def held_sideways(one: SceneRun) -> dict[str, Exact]:
    """Uniform strain: M = E (1 - nu)/((1 + nu)(1 - 2 nu)) in series with two joints."""
    nu = _ratio(one)
    modulus = YOUNG * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    return {"peak": Exact(one.value("peak"), PUSH / (EDGE / modulus + 2.0 / STIFF))}


def free_sideways(one: SceneRun) -> dict[str, Exact]:
    """Uniform stress: E in series with two joints that are all but smooth."""
    return {"peak": Exact(one.value("peak"), PUSH / (EDGE / YOUNG + 2.0 / STIFF))}


def bent(one: SceneRun) -> dict[str, Exact]:
    """The same mesh at nu = 0, times what Timoshenko's 12 EI/L^3/(1 + 12 EI/(kappa G A L^2)) changes."""
    soft = timed_run.run(CHAIN, {**one.knobs, "material.units.poisson_ratio": 0.0})

    def softer(nu: float) -> float:
        return 1.0 + (EDGE / TALL) ** 2 * 2.0 * (1.0 + nu) * 6.0 / 5.0

    return {"peak": Exact(one.value("peak"), soft.value("peak") * softer(0.0) / softer(_ratio(one)))}


SQUEEZED: Knobs = {**COMMON, **chain_of((EDGE,) * 3), "drive.direction": "-z", "specimen.mesh": "fan"}
LOADINGS: dict[str, tuple[Knobs, Compare]] = {
    "squeezed, sides held": (
        {**SQUEEZED, **pascals(normal_stiffness=STIFF, shear_stiffness=STIFF), "support": ENDS + FACES},
        held_sideways,
    ),
    "squeezed, sides free": (
        {**SQUEEZED, **pascals(normal_stiffness=STIFF, shear_stiffness=1e3), "support": ENDS},
        free_sideways,
    ),
    "bent": (
        {
            **COMMON,
            **chain_of((EDGE, TALL, EDGE)),
            **pascals(normal_stiffness=1e13, shear_stiffness=1e13),
            "specimen.mesh_size": "25 mm",
            "drive.direction": "x",
            "support": [{"on": "end", "fix": "all"}, {"on": "top", "fix": ["y", "z"]}],
        },
        bent,
    ),
}
GRIDS = (ratios,)
