"""Do meshed blocks have edges too sharp to touch anything? Faces of tets touch what faces them within 72 deg
(`masonry/detection/narrow.py`), so that an edge of less than half of that touches nothing.
"""

from math import acos, degrees

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.measures import edges_by_place, face_areas_normals_centroids
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


def sharpest_edge(blocks: Blocks, which: np.ndarray) -> tuple[int, float]:
    """The block, of those in which (B,), with the sharpest edge that sticks out, and the angle there in degrees."""
    _, normal, centre = face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    face, _, ends = edges_by_place(blocks)
    keys = np.column_stack([owner[face], ends])
    order = np.lexsort(keys.T)
    same = np.flatnonzero(np.all(keys[order[1:]] == keys[order[:-1]], axis=1))
    one, two = face[order[same]], face[order[same + 1]]
    out = np.einsum("ni,ni->n", normal[one], centre[two] - centre[one]) < 0.0
    one, two = one[out & which[owner[one]]], two[out & which[owner[one]]]
    if not len(one):
        return 0, 180.0
    cosine = np.einsum("ni,ni->n", normal[one], normal[two])
    sharpest = int(np.argmin(cosine))
    return int(owner[one[sharpest]]), 180.0 - degrees(acos(float(np.clip(cosine[sharpest], -1.0, 1.0))))
