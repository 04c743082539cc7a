"""Will joints that stay closed bend or twist too stiffly by their contact points? Asked of a scene whose dead loads
alone act on joints that pull, in their elastic equilibrium; a run says so of others."""

import numpy as np

from geometry.joints.faces.second_moments import lacking_flexibility
from masonry.assembly.assemble import Assembly
from masonry.errors import SceneError
from masonry.estimates.elastic_joints import bend_or_twist, lacking_share
from masonry.estimates.inspection import WITHOUT
from masonry.estimates.joint_faces import dry_groups
from masonry.laboratory.remarks.bending_points import advice_for
from masonry.modal_analysis.oscillator import oscillator_of
from masonry.modal_analysis.pressed import equilibrium

MOST = 20000
"""Contact points up to which it is asked, as it takes one elastic solution."""


def remarks(assembly: Assembly) -> list[str]:
    """One line at most."""
    scene, joints = assembly.scene, assembly.joints
    if scene.drive is not None or scene.limit is not None or dry_groups(assembly).any():
        return []
    if not 0 < len(joints.area) <= MOST or not (lacks := lacking_flexibility(joints)).any:
        return []
    oscillator = oscillator_of(scene)
    if not oscillator.load[oscillator.free].any():
        return []
    try:
        jump = equilibrium(oscillator, np.ones(len(joints.area), dtype=bool))
    except SceneError:  # it does not stand, whatever its points are
        return []
    stiffness = np.column_stack([oscillator.normal, oscillator.shear])
    scaled = np.sqrt(stiffness[:, [0, 1, 1]]) * jump
    more = lacking_share(joints, lacks, stiffness, oscillator.forces(scaled.ravel()), float((scaled**2).sum()))
    error = more / (1.0 + more)
    if error <= WITHOUT:
        return []
    much = f"movements under dead loads may be about {100.0 * error:.2g} % too small"
    return [f"joints that stay closed {bend_or_twist(error)}: {much}; {advice_for(assembly)}"]
