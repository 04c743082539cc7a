"""Contacts of one group with strengths of their own: each follows its own closed form, side by side in lanes."""

import numpy as np
import pytest

from masonry.simd.rows import aligned
from verification.fixtures.one_contact import COUNT, along, law, walk
from verification.references import closed_forms
from verification.references.closed_forms import LAWS, Joint

SHARES = np.linspace(0.6, 1.4, COUNT)
"""Of the strengths of Table 1, from the first contact to the ninth."""
ENERGIES = {"G_I": 5.8 * SHARES**2, "G_II": 58.0 * SHARES**2}


def scattered(name: str, **changes) -> tuple:
    """(parameters, joint) of nine contacts whose strengths and energies grow by SHARES."""
    parameters, joint = law(name, **changes)
    own = {key: aligned(values) for key, values in ENERGIES.items() if hasattr(parameters, key)}
    strengths = {"tensile_strength": aligned(0.58e6 * SHARES), "cohesion": aligned(0.87e6 * SHARES)}
    return parameters._replace(**own), joint._replace(**strengths)


def closed_form_of(which: int) -> Joint:
    """The closed form of one of the nine."""
    return Joint(
        fT=0.58e6 * SHARES[which],
        c0=0.87e6 * SHARES[which],
        G_I=ENERGIES["G_I"][which],
        G_II=ENERGIES["G_II"][which],
    )


@pytest.mark.parametrize("ninth", [False, True], ids=["first", "ninth"])
@pytest.mark.parametrize("name", LAWS)
def test_each_contact_opens_along_the_envelope_of_its_own_strength(name, ninth):
    trace = walk(scattered(name), along([(0.0, 0.0, 0.0), (0.0, 0.0, 60e-6)], 0.05e-6), ninth=ninth)
    wanted = closed_forms.tension(name, closed_form_of(8 if ninth else 0), trace.path[:, 2])
    np.testing.assert_allclose(trace.sigma, wanted, rtol=0, atol=1e-12 * 0.58e6)


@pytest.mark.parametrize("ninth", [False, True], ids=["first", "ninth"])
@pytest.mark.parametrize("compression", [0.0, 0.5e6])
@pytest.mark.parametrize("name", LAWS)
def test_each_contact_slips_along_the_envelope_of_its_own_strength(name, compression, ninth):
    z = -compression / 150e9
    trace = walk(scattered(name), along([(0.0, 0.0, z), (1e-3, 0.0, z)], 0.5e-6), ninth=ninth)
    wanted = closed_forms.shear(name, closed_form_of(8 if ninth else 0), trace.path[:, 0], compression)
    np.testing.assert_allclose(trace.stress[:, 0], wanted, rtol=0, atol=1e-12 * wanted.max())


CASES = [
    ("linear", {}),
    ("polynomial", {}),
    ("exponential", {"dilation_angle": 0.05, "dilation_cutoff": 50e-6}),
    pytest.param(
        "exponential",
        {
            "unloading": "elastic",
            "softening_variable": "plastic",
            "coupling": "independent",
            "residual_cohesion": 0.1e6,
        },
        marks=pytest.mark.slow,
    ),
]
"""Options are the mechanism's, which all laws share: one law has them, as every pair is compiled anew."""


@pytest.mark.parametrize(("name", "options"), CASES, ids=str)
def test_equal_strengths_in_an_array_give_the_bits_of_one_strength_for_all(name, options):
    path = along([(0, 0, 0), (0, 0, 8e-6), (20e-6, 5e-6, 2e-6), (30e-6, 0, -3e-6), (0, 0, 10e-6)], 0.5e-6)
    parameters, joint = law(name, **options)
    same = lambda value: value if value is None else aligned(np.full(COUNT, value))  # noqa: E731
    arrays = (
        parameters._replace(G_I=same(parameters.G_I), G_II=same(parameters.G_II)),
        joint._replace(
            tensile_strength=same(joint.tensile_strength),
            cohesion=same(joint.cohesion),
            dilation_cutoff=same(joint.dilation_cutoff),
        ),
    )
    for ninth in (False, True):
        one, many = walk((parameters, joint), path, ninth=ninth), walk(arrays, path, ninth=ninth)
        for field in ("stress", "dissipated_by_mode", "stored", "intact_n", "intact_s", "slip"):
            np.testing.assert_array_equal(getattr(many, field), getattr(one, field), field)
        assert one.dissipated_by_mode[-1].min() >= 0.0 < one.dissipated_by_mode[-1].max()
