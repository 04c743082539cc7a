"""Do meshed blocks have edges too sharp to touch anything? Faces of tets touch what faces them within 72 deg
(`masonry/detection/narrow.py`), so that an edge of less than half of that touches nothing.
"""

import numpy as np

from geometry.polyhedra.measures import sharpest_edge
from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt

LIMIT = 36.0
"""deg, the least."""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One, of the sharpest edge."""
    mesh, blocks = assembly.mesh, assembly.specimen.blocks
    if mesh is None or not assembly.scene.is_large:
        return []
    block, angle = sharpest_edge(blocks, np.diff(mesh.tet_start) > 0)
    if angle >= LIMIT:
        return []
    sentence = (
        f"block {block} ({blocks.groups[blocks.group[block]]}) has an edge of {angle:.3g} deg: edges of meshed blocks "
        f"sharper than {LIMIT:g} deg sink into what they meet"
    )
    return [Doubt("sharp_edge", angle, LIMIT, sentence, "take another kinematics for it")]
