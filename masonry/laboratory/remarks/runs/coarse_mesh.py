"""Are the tets too large for how the stress varies within blocks? Those of constant strain are too stiff in bending.

The error is estimated from the stress itself (`masonry/estimates/meshes/`). The limit is the accuracy that was asked,
but no less than 5 %, as an estimate is within a factor of 1.5 or so in bending, and of 2 in shear. That of a block is
20 %: it changes little but itself. Not asked is a load that dry joints bear, once it was reached: a fall, or a peak
behind which they gave way.
"""

import numpy as np

from geometry.blocks import TetMesh
from masonry.estimates.inspection import Inspection
from masonry.estimates.meshes.stress_error import LOCK, finer
from masonry.estimates.meshes.tet_energy import excess_energies, friction_decides
from masonry.judgement.doubt import TETS, Doubt
from masonry.scene.tables.specimen import Specimen

LEAST, OF_BLOCK = 0.05, 0.2
"""Limits of all blocks together, and of one."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most: of all blocks, or else of one."""
    assembly, mesh = inspection.assembly, inspection.assembly.mesh
    if mesh is None or not inspection.frames or friction_decides(inspection):
        return []
    limit, excesses = max(inspection.accuracy, LEAST), excess_energies(inspection, mesh)
    worst = max(excesses, key=lambda excess: excess.of_all)
    if worst.of_all > limit:
        words = f"the tets are too large for how stress varies in blocks: {worst.when} the specimen"
        return [_doubt(assembly.scene.specimen, mesh, worst.error, worst.of_all, limit, words)]
    worst = max(excesses, key=lambda excess: excess.of_block)
    if worst.of_block > OF_BLOCK:
        where = ", ".join(f"{x:.4g}" for x in assembly.model.layout.centroid[worst.block])
        words = f"the tets of block {worst.block} at ({where}) m are too large: {worst.when} it"
        return [_doubt(assembly.scene.specimen, mesh, worst.error, worst.of_block, OF_BLOCK, words)]
    return []


def _doubt(specimen: Specimen, mesh: TetMesh, error: np.ndarray, ratio: float, limit: float, words: str) -> Doubt:
    about = "at least" if specimen.mesh == "fan" else "about"  # one layer of tets shows little of what it lacks
    sentence = f"{words} deforms {about} {100.0 * min(ratio, 0.99):.2g} % too little under its loads, {LOCK}"
    advice = finer(mesh, error, ratio, limit, specimen.mesh, specimen.mesh_size)
    return Doubt("coarse_mesh", ratio, limit, sentence, advice, TETS)
