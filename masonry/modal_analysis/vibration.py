"""The modes of a scene: its joints first, then the slowest modes, and what they say."""

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.covered import covered_fractions
from masonry.errors import SceneError
from masonry.modal_analysis.eigen import Modes, slowest
from masonry.modal_analysis.joint_words import joint_words
from masonry.modal_analysis.mesh_words import mesh_words
from masonry.modal_analysis.modes_data import block_of_points, moved_corners, own_points
from masonry.modal_analysis.modes_result import ModesResult
from masonry.modal_analysis.oscillator import Oscillator, oscillator_of
from masonry.modal_analysis.pressed import Pressed, pressed
from masonry.scene import Scene

MOST = 200
"""Modes that may be asked for."""
COVERED = 1.0 - 1e-6
"""Share of a face in joints from which on it is not seen."""
ALIKE = 1e-6
"""Share by which lengths may differ and count as equal."""
MOVES = 1e-6
"""Share of the fastest corner of a loose motion at which a block takes part in it."""
CLOSED = "all joints closed and elastic, at the undeformed shape, without the stiffness that weight adds or takes"
PRESSING = (
    "joints elastic where they press under the dead loads, or hold the tension there, and open elsewhere, at the "
    "undeformed shape, without the stiffness that weight adds or takes"
)


@dataclass(frozen=True)
class ModesSettings:
    """How the modes of a scene are looked for.

    count    of modes
    pressed  whether joints that the dead loads do not press are open
    ratio    of the damping whose Rayleigh numbers are told
    between  the two modes at which it has the ratio; None for the first and the third
    """

    count: int = 6
    pressed: bool = False
    ratio: float = 0.05
    between: tuple[int, int] | None = None

    def require_sense(self) -> None:
        """Raises SceneError for what cannot be."""
        if not 1 <= self.count <= MOST:
            raise SceneError(f"{self.count} modes; allowed: 1 to {MOST}")
        if not 0.0 < self.ratio < 1.0:
            raise SceneError(f"a damping ratio of {self.ratio:g}; allowed: above 0 and below 1, such as 0.05")
        if self.between is not None and not 1 <= self.between[0] < self.between[1] <= self.count:
            raise SceneError(
                f"Rayleigh damping between modes {self.between[0]} and {self.between[1]}: give two of the "
                f"{self.count} modes, the lower one first"
            )


def analyse(scene: Scene, wishes: ModesSettings = ModesSettings()) -> ModesResult:
    """The slowest modes of a scene. Raises SceneError, in one sentence, for what has none."""
    wishes.require_sense()
    begun = perf_counter()
    oscillator = oscillator_of(scene)
    if not oscillator.free.any():
        raise SceneError("supports hold every block, so nothing can vibrate")
    joints = pressed(oscillator) if wishes.pressed else None
    closed = np.ones(len(oscillator.joints.area), dtype=bool) if joints is None else joints.closed
    modes = slowest(oscillator.closed(closed), oscillator.mass, oscillator.free, wishes.count)
    count = len(modes.square)
    blocks = own_points(oscillator.specimen)
    corners = [_corners(oscillator, blocks, shape) for shape in modes.shape]
    effective, mass = effective_masses(oscillator, modes)
    result = ModesResult(
        *(scene, oscillator.specimen, oscillator.layout, CLOSED if joints is None else PRESSING),
        *(np.sqrt(modes.square) / (2.0 * np.pi), effective, mass),
        shapes=[oscillator.by_kind(shape) for shape in modes.shape],
        blocks=blocks,
        corners=np.array(corners).reshape(count, len(blocks.points), 3),
        closed=closed,
        covered=covered_fractions(oscillator.specimen.blocks, oscillator.joints) > COVERED,
        ratio=wishes.ratio,
        between=wishes.between or (1, min(3, max(count, 1))),
        dofs=int(oscillator.free.sum()),
        loose=len(modes.loose),
        loose_blocks=_loose_blocks(oscillator, blocks, modes),
    )
    _say(result, oscillator, modes, joints, wishes)
    result.seconds = perf_counter() - begun
    return result


def effective_masses(oscillator: Oscillator, modes: Modes) -> tuple[np.ndarray, np.ndarray]:
    """(m, 3) kg of each mode along x, y, z: (phi M r)^2 for a modal mass of 1; and (3,) kg that can move."""
    mass = np.where(oscillator.free, oscillator.mass, 0.0)
    along = np.column_stack([oscillator.along(axis) for axis in range(3)])
    return (modes.shape @ (mass[:, None] * along)) ** 2, mass @ along


def _corners(oscillator: Oscillator, blocks: Blocks, shape: np.ndarray) -> np.ndarray:
    """(P, 3) of a mode, the largest is 1 long; its largest component is positive."""
    moved = moved_corners(oscillator.layout, blocks, oscillator.by_kind(shape))
    farthest = moved[_first_largest(np.linalg.norm(moved, axis=1))]
    length = float(np.linalg.norm(farthest)) * np.sign(farthest[_first_largest(np.abs(farthest))])
    return moved / length


def _first_largest(values: np.ndarray) -> int:
    """The first of those that are the largest but for rounding, which is that of a processor."""
    return int(np.argmax(values >= (1.0 - ALIKE) * values.max()))


def _loose_blocks(oscillator: Oscillator, blocks: Blocks, modes: Modes) -> np.ndarray:
    """Numbers of the blocks that take part in motions that nothing resists."""
    block, farthest = block_of_points(blocks), np.zeros(blocks.count)
    for shape in modes.loose:
        moved = np.linalg.norm(_corners(oscillator, blocks, shape), axis=1)
        np.maximum.at(farthest, block, moved)
    return np.flatnonzero(farthest > MOVES)


def _say(
    result: ModesResult, oscillator: Oscillator, modes: Modes, joints: Pressed | None, wishes: ModesSettings
) -> None:
    """Words on what is loose, what slides, and what of the scene is taken otherwise."""
    if result.loose:
        many = f"{result.loose} or more" if not modes.all_loose else f"{result.loose}"
        few = ", ".join(str(block) for block in result.loose_blocks[:5].tolist())
        more = " and others" if len(result.loose_blocks) > 5 else ""
        result.remarks.append(
            f"{many} motion{'s' * (result.loose != 1)} that no joint resists (0 Hz), of block"
            f"{'s' * (len(result.loose_blocks) != 1)} {few}{more}; they are left out of the table"
        )
    if not len(result.frequencies):
        result.remarks.append("no joint and no block is strained by what can move: there is no frequency")
    result.remarks.extend(mesh_words(oscillator, modes))
    result.remarks.extend(joint_words(oscillator, modes.shape, result.closed))
    if joints is not None and joints.slides.any():
        result.remarks.append(
            f"{int(joints.slides.sum())} of {int(joints.closed.sum())} closed contacts would bear more shear than "
            "friction holds there; they are taken as closed, a run lets them slide"
        )
    if oscillator.scene.scatter is not None:
        result.remarks.append("the scatter of the scene is left out: means count")
    words = [plan.words_on_modes() for plan in oscillator.elements]
    result.remarks.extend(word for word in words if word is not None)
    if oscillator.scene.quiet:
        result.remarks.append("quiet boundaries are left out: their faces are free")
    if oscillator.scene.drive is not None:
        result.remarks.append("what the drive moves is free: only supports hold")
    if len(result.frequencies) < wishes.count:
        result.remarks.append(f"there are {len(result.frequencies)} modes and no more")
