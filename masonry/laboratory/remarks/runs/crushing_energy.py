"""Is the energy that crushing took known, where joints crush at an edge (`masonry/estimates/crushed_edges.py`)?

The limit is 3 % of the external work. A run that is made for the factor of a load does not rest on it and is not asked.
"""

import numpy as np

from masonry.estimates.crushed_edges import crushing_error
from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import POINTS, Doubt
from masonry.rows.columns import CRUSHING, FACTOR

OFF = 0.03
"""Of the largest external work."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    rows = inspection.outcome.history.rows if inspection.frames else {}
    scene = inspection.assembly.scene
    if CRUSHING not in rows or FACTOR in rows or inspection.frames[-1].crushing is None:
        return []
    if scene.is_large and any(map(scene.is_meshed, scene.material)):  # its patches are triangles of a mesh
        return []
    energy, work = float(rows[CRUSHING][-1]), float(np.abs(rows["external_work"]).max())
    if energy <= OFF * OFF * work:
        return []
    off = energy / work * crushing_error(inspection, inspection.frames[-1].crushing)
    if off <= OFF:
        return []
    sentence = (
        f"the contact points of joints whose edge crushes are too few for its energy: crushing took {energy:.3g} J, "
        f"give or take {100 * off * work / energy:.2g} %, or {100 * off:.2g} % of the external work"
    )
    key = "specimen.patch_points_per_edge" if scene.is_large else "specimen.points_per_edge along edges that bend"
    advice = f"take more {key}: twice as many halve the error"
    return [Doubt("crushing_energy", off, OFF, sentence, advice, POINTS)]
