import pytest

from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
from masonry.laboratory.text import check_text
from tests import scenes


def row(lengths, masses):
    """Boxes in a row, the first one held and the last one pulled, all of the same face."""
    boxes, place = [], 0.0
    for n, length in enumerate(lengths):
        boxes.append(scenes.box(f"box {n}", (place, 0, 0), (length, 0.1, 0.1), "units", n))
        place += length
    text = scenes.specimen(boxes, 0.01) + scenes.tables("material", {"units": scenes.MATERIAL})
    text += scenes.tables("contact", {"unit_unit": scenes.ELASTIC})
    text += scenes.listed("support", ['on = "box 0"\nfix = "all"'])
    text += f'[drive]\non = "box {len(lengths) - 1}"\ndirection = "x"\ndisplacement = "1 mm"\nsteps = 10\n'
    return scenes.load(text, solver__masses=masses)


EQUAL, THIN = [0.1] * 8, [0.1] * 4 + [0.01] + [0.1] * 3


@pytest.mark.parametrize("masses", ["real", "scaled"])
def test_the_thin_block_is_blamed_and_costs_what_a_row_without_a_thin_block_gains(masses):
    equal, thin = (assemble(row(lengths, masses)).model for lengths in (EQUAL, THIN))
    assert thin.cost.block == 4
    gain = equal.dt / thin.dt
    assert gain > (2.5 if masses == "real" else 1.03)
    assert thin.cost.usual == pytest.approx(gain, rel=0.15 if masses == "real" else 0.02)


@pytest.mark.parametrize("masses", ["real", "scaled"])
def test_two_thin_blocks_share_the_blame_so_that_one_alone_costs_less(masses):
    cost = assemble(row([0.1] * 3 + [0.01, 0.1, 0.01] + [0.1] * 3, masses)).model.cost
    assert cost.block in (3, 5)
    assert 1 - 1e-9 <= cost.without < 0.99 * cost.usual


def test_the_check_says_in_words_what_is_worst_and_what_it_costs():
    text = check_text(laboratory.check(row(THIN, "real")))
    assert "shortest edge        10 mm" in text
    assert "smallest block       100 cm3, 0.11 of its group's mean; block 4 (units, unit 4) at (405, 50, 50) mm" in text
    assert "without the worst, block 4 (units, unit 4)" in " ".join(text.split())


def test_the_check_of_a_row_of_equal_blocks_blames_none_where_only_one_moves():
    assert "none: fewer than two blocks move" in check_text(laboratory.check(row([0.1, 0.1], "real")))
