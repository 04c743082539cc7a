"""Contacts that crush on random cyclic paths: what must hold for each law with a cap or a cut-off, and each option."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from masonry.laws.compression_cap import LEAST, strength_left
from masonry.simd.rows import aligned
from tests.laws.test_random_paths import CHOICES, NAMES, chosen, corners, legs, numbers, strengths, unhurried
from verification.fixtures.one_contact import COUNT, Walk, along, law, walk
from verification.references.closed_forms import LAWS

KN, KS, DEEPER = 150e9, 70e9, 10.0
"""Pa/m; of the paths of laws that do not crush, so that these come down the curve of the strength."""
CRUSHES = {
    "cap": {"crushing": "cap", "closing_at_peak": 3e-6, "fracture_energy_compression": 60.0},
    "cut-off": {"crushing": "cut-off", "fracture_energy_compression": 60.0},
    "for-ever": {"crushing": "cut-off"},
}
USUAL = (
    ("exponential", "cap", (0, 0, 0, 0)),
    ("polynomial", "cap", (0, 1, 0, 1)),
    ("linear", "cut-off", (1, 1, 1, 0)),
    ("brittle", "for-ever", (0, 1, 1, 0)),
)
"""What is not slow to compile: each law, each kind of crushing, each option with and without."""


def combinations():
    """Every law with every option, each time with one kind of crushing in turn, and what is usual."""
    for name, crushing, bits in product(LAWS, CRUSHES, product((0, 1), repeat=4)):
        in_turn = ([*LAWS].index(name) + sum(bits)) % len(CRUSHES) == [*CRUSHES].index(crushing)
        if not in_turn and (name, crushing, bits) not in USUAL:
            continue
        marks = () if (name, crushing, bits) in USUAL else (pytest.mark.slow,)
        options = {key: choice[k] for key, choice, k in zip(NAMES, CHOICES, bits, strict=True)}
        words = "-".join([name, crushing, *(str(v) for v in options.values() if v != 0.0)])
        yield pytest.param(name, options | CRUSHES[crushing], id=words, marks=marks)


every_law_that_crushes = pytest.mark.parametrize(("name", "options"), list(combinations()))
compressions = st.fixed_dictionaries(
    {"compressive_strength": st.sampled_from([0.4e6, 1e6, 1.8e6]), "cap_shear_factor": st.sampled_from([0.0, 1.0, 9.0])}
)


def crushing(name: str, options: dict, values: dict, compression: dict) -> tuple:
    return chosen(name, options | compression, values)


def deep(points: np.ndarray) -> np.ndarray:
    """The same, pressed further."""
    return points * np.where(points[:, 2:] < 0.0, [[1.0, 1.0, DEEPER]], [[1.0, 1.0, 1.0]])


def beyond_cap(joint, trace: Walk) -> np.ndarray:
    """Pa by which the stresses lie outside of the cap."""
    assert trace.crushed is not None
    strength = np.array([float(strength_left(joint, k)) for k in trace.crushed[:, 1]])
    pressed = np.minimum(trace.sigma, 0.0)
    return np.sqrt(pressed**2 + (joint.cap_shear_factor or 0.0) * trace.tau**2) - strength


@every_law_that_crushes
@settings(unhurried, max_examples=40)
@given(points=corners(), values=numbers, compression=compressions, steps=st.sampled_from([1, 7, 60]))
def test_nothing_is_given_back_and_nothing_heals(name, options, points, values, compression, steps):
    built = crushing(name, options, values, compression)
    joint, trace = built[1], walk(built, legs(deep(points), steps))
    assert np.isfinite(trace.stress).all() and np.isfinite(trace.stored).all()
    modes = np.diff(trace.dissipated_by_mode, axis=0, prepend=0.0)
    rounding = 1e-12 * (np.max(trace.dissipated) + 1e-6)
    assert modes[:, [0, 1, 3]].min() >= -rounding
    if joint.tan_dilation is None:
        assert modes[:, 2].min() >= -rounding
    assert np.diff(trace.dissipated, prepend=0.0).min() >= -rounding and trace.stored.min() >= -rounding
    assert np.diff(trace.crushed, axis=0, prepend=0.0).min() >= 0.0
    for falling in (trace.intact_n, trace.intact_s, -trace.opening_max):
        assert np.diff(falling, prepend=falling[0]).max() <= 0.0
    tensile, shear = strengths(joint, trace)
    assert np.all(trace.tau <= shear * (1 + 1e-9) + 1e-3) and np.all(trace.sigma <= tensile * (1 + 1e-9) + 1e-3)
    if joint.tan_dilation is None:  # what dilation presses in a step the cap sees in the next
        assert beyond_cap(joint, trace).max() <= 1e-8 * joint.compressive_strength + LEAST * KN * DEEPER * 12e-6


@every_law_that_crushes
@settings(unhurried, max_examples=12)
@given(points=corners(), values=numbers, compression=compressions)
def test_energy_is_neither_made_nor_lost_as_the_steps_get_shorter(name, options, points, values, compression):
    if name == "brittle":  # a drop falls anywhere in its step
        return
    built = crushing(name, options, values | {"tensile_strength": 0.2e6, "cohesion": 0.3e6}, compression)
    walks = [walk(built, legs(deep(points), steps)) for steps in (100, 400, 6400)]
    errors = [np.abs(one.gap).max() for one in walks]
    scale = walks[-1].dissipated[-1] + walks[-1].stored.max() + 1e-9
    assert errors[-1] <= 0.2 * max(errors) + 1e-4 * scale


@every_law_that_crushes
@settings(unhurried, max_examples=12)
@given(points=corners(), values=numbers, compression=compressions)
def test_force_is_continuous(name, options, points, values, compression):
    """A quarter of the step, a quarter of the largest jump, unless that is what springs make of the step."""
    if name == "brittle":
        return
    built = crushing(name, options, values | {"tensile_strength": 0.2e6, "cohesion": 0.3e6}, compression)
    walks = [walk(built, legs(deep(points), steps)) for steps in (800, 3200)]
    coarse, fine = (np.linalg.norm(np.diff(w.stress, axis=0, prepend=0.0), axis=1).max() for w in walks)
    step = np.linalg.norm(np.diff(walks[1].path, axis=0), axis=1).max()
    assert fine <= max(0.3 * coarse, (KN + KS) * step)


@pytest.mark.parametrize("words", ["cap", "cut-off"])
def test_a_dry_joint_crushes_and_slides(words):
    """Law friction: at the corner of cap and Coulomb line both hold."""
    built = law("friction", tan_friction=0.15, compressive_strength=1e6, **CRUSHES[words])
    trace = walk(built, along([(0, 0, 0), (0, 0, -6e-6), (80e-6, 0, -26e-6)], 0.2e-6))
    end = slice(-40, None)
    np.testing.assert_allclose(trace.tau[end], -0.15 * trace.sigma[end], rtol=1e-9)
    assert np.abs(beyond_cap(built[1], trace)[end]).max() < 1e-8 * 1e6
    assert trace.dissipated_by_mode[-1, 2] > 0.0 < trace.dissipated_by_mode[-1, 3]


def test_scattered_contacts_crush_each_by_its_own_strength():
    parameters, joint = law("exponential", compressive_strength=1e6, **CRUSHES["cap"])
    own = joint._replace(compressive_strength=aligned(np.linspace(0.5e6, 1.5e6, COUNT)))
    path = along([(0, 0, 0), (0, 0, -30e-6), (4e-6, 0, -60e-6), (0, 0, 10e-6)], 0.5e-6)
    for ninth, strength in ((False, 0.5e6), (True, 1.5e6)):
        alone = walk((parameters, joint._replace(compressive_strength=strength)), path)
        among = walk((parameters, own), path, ninth=ninth)
        np.testing.assert_array_equal(among.stress, alone.stress)
        np.testing.assert_array_equal(among.dissipated_by_mode, alone.dissipated_by_mode)
