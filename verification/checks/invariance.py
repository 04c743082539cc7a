"""A wall of five blocks that is shifted, turned, mirrored and renumbered; what its contacts do to both sides."""

from collections.abc import Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from masonry.configuration.energy import present
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.building.factory import build
from masonry.model.loads import Push
from masonry.model.model import Model, Stepping
from verification.case import Findings, Tolerance
from verification.checks.free_motion import STRONG, follow
from verification.fixtures import assembled, models, shapes
from verification.fixtures.one_contact import TABLE_1

ROTATIONS = {
    "turned by 45 degrees about (1, 2, 3)": Rotation.from_rotvec(np.pi / 4 * np.array([1, 2, 3]) / 14**0.5).as_matrix(),
    "turned by 90 degrees about z": np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
    "mirrored": np.diag([-1.0, 1.0, 1.0]),
    "shifted by 1 m": np.eye(3),
}
SHIFT = np.array([0.6, -0.5, 0.62])
ORDER = np.array([3, 0, 4, 2, 1])
SHEAR = np.array([[1.0, 0.3, 0.2], [0.1, 1.0, -0.2], [0.0, 0.15, 0.9]])
SOFT = build(
    "unit_unit",
    ContactProperties.of({
        **TABLE_1, "law": "exponential", "tensile_strength": 0.2e6, "cohesion": 0.3e6, "tan_friction": 0.9,
        "tan_residual_friction": 0.6, "fracture_energy_mode_1": 2.0, "fracture_energy_mode_2": 20.0,
    }),
)  # fmt: skip
KIND = "invariance"
LEVI_CIVITA = np.zeros((3, 3, 3))
for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    LEVI_CIVITA[i, j, k], LEVI_CIVITA[i, k, j] = 1.0, -1.0


def wall(kinds: Sequence[str], skew: bool = False) -> shapes.Setup:
    """Two courses of two in running bond, and a block on top of them."""
    x = [((0.0, 0.0), (0.2, 0.08)), ((0.2, 0.0), (0.4, 0.08)), ((0.1, 0.08), (0.3, 0.16)), ((0.3, 0.08), (0.5, 0.16))]
    x.append(((0.15, 0.16), (0.4, 0.25)))
    blocks = shapes.boxes([((a[0], 0.0, a[1]), (b[0], 0.1, b[1])) for a, b in x])
    return shapes.setup(shapes.skewed(blocks, SHEAR) if skew else blocks, kinds, mesh_size=0.09)


def resultant(model: Model, values: dict[str, np.ndarray]) -> np.ndarray:
    """(6,) sum and moment about the origin of forces (or momenta) given on the dofs of each kind."""
    total, layout = np.zeros(6), model.layout
    for kind, _ in present(model):
        f = values[kind]
        which = layout.members[kind]
        place = layout.centroid[which] if layout.mesh is None or kind != "tets" else layout.mesh.nodes
        total[:3] += f[:, :3].sum(axis=0)
        total[3:] += np.cross(place, f[:, :3]).sum(axis=0)
        if kind == "rigid":
            total[3:] += np.einsum("bij,bj->i", layout.axes[which], f[:, 3:])
        if kind == "affine":
            first_moment = np.einsum("bjl,bkl->bjk", layout.axes[which], f[:, 3:].reshape(-1, 3, 3))
            total[3:] += np.einsum("ijk,bjk->i", LEVI_CIVITA, first_moment)
    return total


def momentum(model: Model) -> np.ndarray:
    """(6,) linear (kg m/s) and angular momentum (kg m2/s)."""
    return resultant(model, {kind: model.masses[kind] * body.v for kind, body in present(model)})


def contact_forces(model: Model) -> np.ndarray:
    """(6,) N, N m: what all contacts together do to all blocks."""
    return resultant(model, {kind: body.contact for kind, body in present(model)})


def rigid_motion(findings: Findings, kinds: Sequence[str], words: str) -> None:
    """All blocks move and turn together: no force at all. And contacts push both sides alike, along one line."""
    rotation = next(iter(ROTATIONS.values()))
    model = models.make(shapes.mapped(wall(kinds, skew=True), rotation, SHIFT), STRONG)
    random = np.random.default_rng(1)
    spin = random.normal(size=3)
    rigid = models.linear_field(model, random.normal(size=3), np.cross(np.eye(3), -spin))
    noise = random.normal(size=len(rigid)) * np.abs(rigid).max()
    scale = float(np.abs(models.forces(model, noise)).max())
    everywhere = float(np.abs(model.contacts.force).sum())
    unequal = float(np.abs(contact_forces(model)).max())
    left = float(np.abs(models.forces(model, rigid)).max())
    tolerance = Tolerance(1e-13, 3e-15, "differences of displacements that are alike: rounding", KIND)
    findings.check(f"{words}: force of a rigid motion, largest", "N", left, 0.0, tolerance, scale=scale)
    tolerance = Tolerance(1e-13, 1e-16, "the same numbers with both signs: rounding of their sums", KIND)
    findings.check(f"{words}: sum and moment of all contact forces", "N", unequal, 0.0, tolerance, scale=everywhere)


def kept_momentum(findings: Findings, kinds: Sequence[str], words: str) -> None:
    """Free blocks that fly apart and crack their joints keep their momentum and their angular momentum."""
    model = models.make(wall(kinds, skew=True), SOFT)
    random = np.random.default_rng(3)
    for _, body in present(model):
        body.v[:] = random.normal(size=body.v.shape) * 0.04
    before = momentum(model)
    swing = sum(float(np.abs(model.masses[kind] * body.v).sum()) for kind, body in present(model))
    name = f"{words}: cracking apart"
    follow(findings, name, model, 3000, lambda m: np.zeros(1), every=100)
    off = float(np.abs(momentum(model) - before).max())
    quantity = f"{words}: momentum and angular momentum after 3000 steps"
    findings.check(quantity, "kg m/s", off, 0.0, Tolerance(1e-12, 1e-14, "rounding of 3000 kicks", KIND), scale=swing)
    _weakest(findings, f"{words}: strength left of the weakest joint meanwhile", model)


def _weakest(findings: Findings, words: str, model: Model) -> None:
    """The scene is worth something only if joints crack in it."""
    left = float(model.state.intact_n.min())
    findings.at_most(words, "1", left, 0.9, "any loss of a tenth will do")


def _loaded(setup: shapes.Setup, law: tuple, rotation: np.ndarray, stepping: Stepping, order: np.ndarray) -> Model:
    """Blocks 0 and 1 (by their old numbers) held; weight, and a traction on top."""
    where = np.argsort(order)
    push = Push(np.array([setup.blocks.block_face_start[where[4]]]), rotation @ np.array([6e4, 3e4, -3e4]))
    supports = models.everything(int(where[0]), int(where[1]))
    return models.make(setup, law, stepping, [supports], [push], gravity=rotation @ np.array([80.0, 60.0, -40.0]))


def alike(findings: Findings, kinds: Sequence[str], words: str, law: tuple, steps: int, stepping: Stepping) -> None:
    """Displacements of blocks and nodes of the scene as it stands, and however it is turned or numbered."""
    still, rest = wall(kinds), np.arange(5)
    plain = _loaded(still, law, np.eye(3), stepping, rest)
    follow(findings, f"{words}: as it stands", plain, steps, lambda m: np.zeros(1), every=steps // 20)
    was = models.displacements(plain)
    scale = max(float(np.abs(field).max(initial=0.0)) for field in was)
    why = "rounding, whose share grows with the steps in which joints soften"
    if law is SOFT:
        _weakest(findings, f"{words}: strength left of the weakest joint", plain)
    for name, rotation in ROTATIONS.items():
        setup = shapes.mapped(still, rotation, SHIFT if "shifted" in name else np.zeros(3))
        model = _loaded(setup, law, rotation, stepping, rest)
        follow(findings, f"{words}: {name}", model, steps, lambda m: np.zeros(1), every=steps // 20)
        now = models.displacements(model)
        off = max(float(np.abs(b - a @ rotation.T).max(initial=0.0)) for a, b in zip(was, now, strict=True))
        tolerance = Tolerance(1e-12, 1e-14, why, KIND)
        findings.check(f"{words}: {name}, displacements", "m", off, 0.0, tolerance, scale=scale)
    other, nodes = shapes.renumbered(still, ORDER)
    model = _loaded(other, law, np.eye(3), stepping, ORDER)
    follow(findings, f"{words}: renumbered", model, steps, lambda m: np.zeros(1), every=steps // 20)
    now = models.displacements(model)
    off = float(np.abs(now[0] - was[0][ORDER]).max())
    off = max(off, float(np.abs(now[1] - was[1][nodes]).max(initial=0.0)))
    tolerance = Tolerance(1e-12, 1e-14, why, KIND)
    findings.check(f"{words}: renumbered, displacements", "m", off, 0.0, tolerance, scale=scale)


def study(findings: Findings, kinds: Sequence[str], words: str, steps: int) -> None:
    """Everything: forces, momentum, the answer at rest, and a wall that cracks while it swings."""
    rigid_motion(findings, kinds, words)
    kept_momentum(findings, kinds, words)
    alike(findings, kinds, f"{words}, at rest", STRONG, steps, Stepping("scaled", damping=0.8))
    model = _loaded(wall(kinds), STRONG, np.eye(3), Stepping("real", damping=0.0), np.arange(5))
    dt = 0.4 * 2.0 / assembled.fastest(model, assembled.stiffness(model, models.STONE))[0]
    alike(findings, kinds, f"{words}, cracking", SOFT, 1500, Stepping("real", dt, damping=0.0))
