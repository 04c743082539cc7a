"""Eigenfrequencies of small models, and the largest stable step that follows from them."""

import numpy as np

from masonry.kinematics.motion import Guided
from masonry.model.model import Model
from verification.fixtures.models import free, mass_vector, stiffness_matrix


def frequencies(model: Model) -> np.ndarray:
    """Ascending eigenfrequencies (rad/s) of the model, from its exact stiffness and its masses of motion."""
    which = free(model)
    root = np.sqrt(mass_vector(model)[which])
    matrix = stiffness_matrix(model)[np.ix_(which, which)] / np.outer(root, root)
    return np.sqrt(np.maximum(np.linalg.eigvalsh(0.5 * (matrix + matrix.T)), 0.0))


def true_limit(model: Model) -> float:
    """2/w_max/sqrt(1 + xi) in seconds, from the exact stiffness matrix and the masses of motion."""
    assert not isinstance(model.damping, Guided)
    return float(2.0 / frequencies(model)[-1] / np.sqrt(1.0 + (model.damping or 0.0)))
