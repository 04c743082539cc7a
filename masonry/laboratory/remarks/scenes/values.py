"""Can the values of a scene be meant? Some are beyond all masonry, by a wrong unit mostly.

The heaviest matter there is has 22,600 kg/m3; the roughest joints of stone have a coefficient of friction of 1.5; what
falls by 500 m comes down at 100 m/s.
"""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt
from masonry.scene import Scene

HEAVIEST, ROUGHEST, FASTEST = 30_000.0, 10.0, 100.0
"""kg/m3, coefficient of friction, m/s."""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One for each value that cannot be meant."""
    return [
        Doubt("value", value, most, f"{key} = {value:.4g}{' ' * bool(unit)}{unit}: {why}", "check its unit")
        for key, value, most, unit, why in values_of(assembly.scene)
        if value > most
    ]


def values_of(scene: Scene) -> list[tuple[str, float, float, str, str]]:
    """Key, value, the most that makes sense, unit, and what is said beyond it."""
    heavy = "this is heavier than any matter"
    rough = f"no joint is as rough: above {ROUGHEST:g} it cannot slide, and says nothing of friction"
    fast = f"this is faster than {FASTEST:g} m/s"
    values = [(f"material.{name}.density", m.density, HEAVIEST, "kg/m3", heavy) for name, m in scene.material.items()]
    values += [(f"fill.{k}.density", fill.density, HEAVIEST, "kg/m3", heavy) for k, fill in enumerate(scene.fill)]
    for name, contact in scene.contact.items():
        key = "friction_angle" if contact.tan_friction_angle is None else "tan_friction_angle"
        words = rough if contact.tan_friction_angle is not None else f"the tangent of this angle; {rough}"
        values.append((f"contact.{name}.{key}", contact.tan_friction or 0.0, ROUGHEST, "", words))
    for k, motion in enumerate(scene.motion):
        values.append((f"motion.{k}.velocity", float(np.linalg.norm(motion.velocity)), FASTEST, "m/s", fast))
    if scene.drive is not None and scene.drive.rate is not None:
        values.append(("drive.rate", scene.drive.rate, FASTEST, "m/s", fast))
    return values
