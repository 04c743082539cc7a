"""Do meshed blocks lock? Tets of constant strain are too stiff where a material hardly changes its volume.

Up to a Poisson ratio of 0.3 they are hardly stiffer than at 0; LOCKED has how much they are beyond.
"""

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt

LIMIT = 0.3
LOCKED = (
    (0.3, (0.113, 0.169, 0.036)),
    (0.4, (0.131, 0.22, 0.107)),
    (0.45, (0.157, 0.304, 0.229)),
    (0.49, (0.213, 0.722, 0.922)),
    (0.499, (0.242, 2.92, 6.53)),
    (0.4999, (0.236, 10.3, 58.9)),
)
"""Poisson's ratio, and by how much tets, four across, are too stiff there: a cube in shear, a cantilever four times as
long as high in bending, a cube pressed between rough stiff plates; against quadratic tets on the same mesh."""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One for each material of meshed blocks."""
    scene = assembly.scene
    return [
        Doubt(
            "locking",
            material.poisson_ratio,
            LIMIT,
            f"material.{name}: constant-strain tets lock at a Poisson ratio of {material.poisson_ratio:g}: "
            f"{locking_text(material.poisson_ratio)}",
            'take kinematics = "affine": affine blocks do not lock',
        )
        for name, material in scene.material.items()
        if material.poisson_ratio is not None and material.poisson_ratio > LIMIT and scene.is_meshed(name)
    ]


def locking_text(nu: float) -> str:
    """By how much tets are too stiff at a Poisson ratio: the figures of the next one in the table."""
    shear, bending, pressed = next((excess for ratio, excess in LOCKED if ratio >= nu), LOCKED[-1][1])
    times = [f"{100 * x:.0f} %" if x < 2.0 else f"{1 + x:.0f} times" for x in (shear, bending, pressed)]
    return (
        f"four across, they are too stiff by up to {times[0]} in shear, {times[1]} in bending, {times[2]} pressed "
        "between plates"
    )
