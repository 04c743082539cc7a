"""Does a mesh give its block too much rotational inertia? The mass of a tet lies at its corners, so that a coarsely
meshed block turns too slowly.

Of a motion in real time alone, and of blocks that nothing holds. 5 % more inertia is 2.5 % less speed.
"""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.estimates.meshes.inertia import inertia_excess
from masonry.judgement.doubt import Doubt

LIMIT, SIZE = 0.05, "specimen.mesh_size"
OF_FAN = f'take specimen.mesh = "gmsh" with a {SIZE} that is a fraction of the block'


def doubts(assembly: Assembly) -> list[Doubt]:
    """One, of the worst block."""
    mesh, model, blocks = assembly.mesh, assembly.model, assembly.specimen.blocks
    if mesh is None or not assembly.scene.is_large or model.scaled:
        return []
    supported = np.zeros(blocks.count, dtype=bool)
    node_block = np.repeat(np.arange(blocks.count), np.diff(mesh.node_start))
    supported[node_block[~model.bodies.tets.dt_over_mass.any(axis=1)]] = True
    excess = np.where(supported, 0.0, inertia_excess(mesh, model.layout.centroid))
    if excess.max(initial=0.0) <= LIMIT:
        return []
    worst = int(np.argmax(excess))
    sentence = (
        f"the mesh gives block {worst} ({blocks.groups[blocks.group[worst]]}) {100 * excess[worst]:.0f} % too much "
        "rotational inertia, so that it turns too slowly"
    )
    fan = assembly.scene.specimen.mesh == "fan"
    return [Doubt("mesh_inertia", float(excess[worst]), LIMIT, sentence, OF_FAN if fan else "take a smaller " + SIZE)]
