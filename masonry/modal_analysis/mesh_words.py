"""By how much tets of constant strain, too stiff in bending, make the frequencies of a scene too high.

The stiffness that a mode shows is too high by the share of its energy that is in error, as
`masonry/estimates/meshes/stress_error.py` estimates it; its frequency goes with the root of the stiffness.
"""

import numpy as np

from masonry.estimates.meshes.stress_error import MOST, finer, mesh_error, tet_stresses
from masonry.modal_analysis.eigen import Modes
from masonry.modal_analysis.oscillator import Oscillator

TOLD = 0.05
"""Share of the energy from which on it is told: 2.5 % of a frequency."""
SHOWN = 6
"""Modes that are named, at most."""


def mesh_words(oscillator: Oscillator, modes: Modes) -> list[str]:
    """A line, where a frequency is too high."""
    mesh, specimen = oscillator.layout.mesh, oscillator.scene.specimen
    if mesh is None:
        return []
    lame = np.repeat(oscillator.lame, np.diff(mesh.tet_start), axis=0)
    high, size = [], ""
    for number, (square, shape) in enumerate(zip(modes.square, modes.shape, strict=True), start=1):
        error = mesh_error(mesh, tet_stresses(mesh, oscillator.by_kind(shape)["tets"], lame), lame)[1]
        share = min(float(2.0 * error.sum() / square), MOST)
        if share > TOLD:
            high.append(f"{100.0 * (1.0 / np.sqrt(1.0 - share) - 1.0):.2g} % in mode {number}")
            size = size or finer(mesh, error, share, TOLD, specimen.mesh, specimen.mesh_size)
    if not high:
        return []
    words = "the tets are too large where blocks bend, so that frequencies are too high, by about"
    return [f"{words} {', '.join(high[:SHOWN])}; {size}"]
