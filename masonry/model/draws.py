"""Draws of lognormal properties, one set for each unit or pair of units, that depend on nothing but seed and names."""

import zlib
from collections.abc import Sequence
from statistics import NormalDist

import numpy as np

PROPERTIES = (
    *("tensile_strength", "cohesion", "fracture_energy_mode_1", "fracture_energy_mode_2"),
    *("compressive_strength", "fracture_energy_compression"),
)
"""What can be drawn, each with a place of its own in a set of draws: naming one more leaves the others as they were."""


def pairs_of(unit_a: np.ndarray, unit_b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(J, 2) numbers of the two units of each joint, lower first, and (C,) the joint of contacts of units a and b (C,).

    All contacts between two units are one joint, wherever cells and meshes divide it; within one unit both numbers are
    the same.
    """
    units = np.sort(np.column_stack([unit_a, unit_b]), axis=1)
    pairs, joint = np.unique(units, axis=0, return_inverse=True)
    return pairs.reshape(-1, 2), joint.reshape(-1)


def standard_normals(seed: int, group: str, pairs: np.ndarray) -> np.ndarray:
    """(J, 1 + properties) independent standard normal numbers for joints between units (J, 2); the first is shared.

    Each joint has a seed sequence of its own, of the seed, the name of its group and the two units: what other joints
    and groups there are does not matter. Numpy promises to keep these sequences, other than those of its generators.
    """
    word = zlib.crc32(group.encode())
    normal = NormalDist()
    result = np.empty((len(pairs), 1 + len(PROPERTIES)))
    for row, (a, b) in zip(result, pairs.tolist(), strict=True):
        bits = np.random.SeedSequence([seed, word, a, b]).generate_state(len(row), np.uint64)
        row[:] = [normal.inv_cdf(((int(x) >> 11) + 0.5) * 2.0**-53) for x in bits]
    return result


def lognormal(mean: float, variation: float, normal: np.ndarray) -> np.ndarray:
    """Values of a lognormal distribution with this mean and coefficient of variation, for standard normal numbers.

    ln(x) has the variance s^2 = ln(1 + variation^2) and the mean ln(mean) - s^2/2.
    """
    variance = np.log1p(variation**2)
    return mean * np.exp(np.sqrt(variance) * normal - 0.5 * variance)


def correlated(normals: np.ndarray, properties: Sequence[str], correlation: float) -> dict[str, np.ndarray]:
    """(J,) standard normal numbers by property, of standard_normals: any two have this correlation, 0 to 1."""
    own, shared = np.sqrt(1.0 - correlation), np.sqrt(correlation)
    return {key: shared * normals[:, 0] + own * normals[:, 1 + PROPERTIES.index(key)] for key in properties}
