"""What a user should know of blocks that are meshed with tets: where they lock, turn too slowly, or do not touch."""

from math import acos, degrees

import numpy as np

from geometry.blocks import Blocks, TetMesh
from geometry.polyhedra.measures import edges_by_place, face_areas_normals_centroids
from masonry.assembly.assemble import Assembly
from masonry.model.layout import tet_volumes

LOCKING = 0.3
"""Poisson's ratio up to which constant-strain tets are hardly stiffer than at 0."""
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
HEAVY = 0.05
"""Share by which the rotational inertia of a meshed block may be too large before that is told."""
SHARP = 36.0
"""deg: faces of tets touch what faces them within 72 deg (detection/narrow.py), so that sharper edges touch nothing."""


def mesh_remarks(assembly: Assembly) -> list[str]:
    """One line for each."""
    found, mesh, model = [], assembly.mesh, assembly.model
    for name, material in assembly.scene.material.items():
        nu = material.poisson_ratio
        if nu is not None and nu > LOCKING and assembly.scene.kinematics_of(name) == "tets":
            found.append(f"material.{name}: constant-strain tets lock at a Poisson ratio of {nu:g}: {locking_text(nu)}")
    if mesh is None or model.large is None:
        return found
    blocks, meshed = assembly.specimen.blocks, np.diff(mesh.tet_start) > 0
    held = np.zeros(blocks.count, dtype=bool)
    node_block = np.repeat(np.arange(blocks.count), np.diff(mesh.node_start))
    held[node_block[~model.bodies.tets.dt_over_mass.any(axis=1)]] = True
    excess = np.where(held, 0.0, inertia_excess(mesh, model.layout.centroid))
    if not model.scaled and excess.max(initial=0.0) > HEAVY:
        worst = int(np.argmax(excess))
        found.append(
            f"the mesh gives block {worst} ({blocks.groups[blocks.group[worst]]}) {100 * excess[worst]:.0f} % too much "
            "rotational inertia, as the mass of a tet lies at its corners, so that it turns too slowly; take a smaller "
            "specimen.mesh_size"
        )
    block, angle = sharpest_edge(blocks, meshed)
    if angle < SHARP:
        found.append(
            f"block {block} ({blocks.groups[blocks.group[block]]}) has an edge of {angle:.3g} deg: edges of meshed "
            f"blocks sharper than {SHARP:g} deg sink into what they meet; take another kinematics for it"
        )
    return found


def inertia_excess(mesh: TetMesh, centroid: np.ndarray) -> np.ndarray:
    """(B,) by what share the polar moment of masses at the nodes, a quarter of each tet, is larger than that of the
    tets; 0 for blocks without. Of a tet it is V/20 (sum |r|^2 + |sum r|^2), at its corners V/4 sum |r|^2."""
    block = np.repeat(np.arange(len(centroid)), np.diff(mesh.tet_start))
    arm, volume = mesh.nodes[mesh.tets] - centroid[block][:, None], tet_volumes(mesh)
    squares = np.einsum("tki,tki->t", arm, arm)
    spread = (squares + np.sum(arm.sum(axis=1) ** 2, axis=1)) / 20.0
    lumped, exact = (np.bincount(block, volume * part, len(centroid)) for part in (squares / 4.0, spread))
    return np.asarray(np.divide(lumped - exact, exact, out=np.zeros_like(exact), where=exact > 0.0))


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


def locking_text(nu: float) -> str:
    """By how much tets are too stiff at a Poisson ratio: the figures of the next one in the table."""
    shear, bending, pressed = next((excess for ratio, excess in LOCKED if ratio >= nu), LOCKED[-1][1])
    times = [f"{100 * x:.0f} %" if x < 2.0 else f"{1 + x:.0f} times" for x in (shear, bending, pressed)]
    return (
        f"four across, they are too stiff by up to {times[0]} in shear, {times[1]} in bending, {times[2]} pressed "
        "between plates; affine blocks do not lock"
    )
