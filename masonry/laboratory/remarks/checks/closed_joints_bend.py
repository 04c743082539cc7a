"""Will joints that stay closed bend or twist too stiffly by their contact points? Asked of a scene whose dead loads
alone act on joints that pull, in their elastic equilibrium; a run says so of others."""

import numpy as np

from geometry.joints.second_moments import lacking_flexibility
from masonry.assembly.assemble import Assembly
from masonry.errors import SceneError
from masonry.estimates.elastic_joints import lacking_work
from masonry.laboratory.remarks.bending_points import advice_for
from masonry.laboratory.remarks.edge_reach import is_dry
from masonry.laboratory.remarks.inspection import WITHOUT
from masonry.modal_analysis.oscillator import oscillator_of
from masonry.modal_analysis.pressed import equilibrium

MOST = 20000
"""Contact points up to which it is asked, as it takes one elastic solution."""


def remarks(assembly: Assembly) -> list[str]:
    """One line at most."""
    scene, joints = assembly.scene, assembly.joints
    dry = any(is_dry(assembly, g) for g in range(len(assembly.model.group_names)))
    if scene.drive is not None or scene.limit is not None or dry or not 0 < len(joints.area) <= MOST:
        return []
    lacks = lacking_flexibility(joints)
    if not lacks.any:
        return []
    oscillator = oscillator_of(scene)
    if not oscillator.load[oscillator.free].any():
        return []
    try:
        jump = equilibrium(oscillator, np.ones(len(joints.area), dtype=bool))
    except SceneError:  # it does not stand, whatever its points are
        return []
    stiffness = np.column_stack([oscillator.normal, oscillator.shear])
    root = np.sqrt(stiffness[:, [0, 1, 1]])
    more = lacking_work(joints, lacks, stiffness, oscillator.forces((root * jump).ravel()))
    off = more / max(float(((root * jump) ** 2).sum()) + more, 1e-300)
    if off <= WITHOUT:
        return []
    much = f"movements under dead loads may be about {100.0 * off:.2g} % too small"
    return [
        f"joints that stay closed bend or twist too stiffly by their contact points: {much}; {advice_for(assembly)}"
    ]
