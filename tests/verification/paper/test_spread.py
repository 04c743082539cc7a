"""What is chance and what is not, on made-up peaks."""

import numpy as np
import pytest

from verification.paper.sizes.spread import spread_of


def test_seeds_that_scatter_alike_at_every_size_show_no_effect_of_size():
    scatter = [0.98, 1.02, 1.0, 0.99, 1.01]
    spread = spread_of({"218": scatter, "335": scatter[::-1], "540": scatter})
    assert spread.between == 0.0 and spread.chance == pytest.approx(1.0)
    assert spread.within == pytest.approx(np.std(scatter, ddof=1))
    assert spread.reach == pytest.approx(0.0)


def test_sizes_that_differ_by_more_than_their_seeds_are_told_apart():
    spread = spread_of({"218": [1.0, 1.01, 0.99], "335": [1.1, 1.11, 1.09], "540": [1.2, 1.21, 1.19]})
    assert spread.chance < 1e-4
    assert spread.between == pytest.approx(0.1, rel=0.01)
    assert spread.reach == pytest.approx(0.2 / 1.1)


def test_the_parts_of_a_known_scatter_are_found_again():
    made = np.random.default_rng(3)
    shift = made.normal(0.0, 2.0, 400)
    spread = spread_of({str(k): 10.0 + s + made.normal(0.0, 1.0, 5) for k, s in enumerate(shift)})
    assert spread.within == pytest.approx(1.0, rel=0.05)
    assert spread.between == pytest.approx(2.0, rel=0.1)


def test_chance_is_as_often_below_a_tenth_as_it_should_be():
    made = np.random.default_rng(5)
    seen = [spread_of({k: made.normal(0.0, 1.0, 5) for k in "abc"}).chance for _ in range(1000)]
    assert np.mean(np.array(seen) < 0.1) == pytest.approx(0.1, abs=0.03)


def test_values_without_scatter_are_told_apart_for_certain():
    assert spread_of({"a": [1.0, 1.0], "b": [2.0, 2.0]}).chance == 0.0
    assert spread_of({"a": [1.0, 1.0], "b": [1.0, 1.0]}).chance == 1.0


@pytest.mark.parametrize("groups", [{"a": [1.0, 2.0]}, {"a": [1.0], "b": [2.0]}, {"a": [1.0, 2.0], "b": []}])
def test_too_few_values_are_refused(groups):
    with pytest.raises(ValueError, match="two groups or more"):
        spread_of(groups)
