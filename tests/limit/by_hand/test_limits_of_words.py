"""What limit analysis says of its factor, asked on either side of each limit; the limits stand here as numbers."""

import json
import sys
from dataclasses import replace

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from masonry.limit_analysis import analysis, corner_points
from masonry.limit_analysis.contact_strengths import rises, touching
from masonry.statics.no_dilation import Flat
from tests.limit.one_block import SIDEWAYS, STRONG, block
from tests.scenes import load

FEEBLE = STRONG.replace('"100 kPa"', '"0 Pa"').replace('"4 kPa"', '"0 Pa"')


def dilating(share: float) -> str:
    """Keys of a joint that rises by a share of the tangent of its friction angle."""
    return f'dilation_angle = "{float(np.degrees(np.arctan(0.7 * share)))!r} deg"\ndilation_cutoff = "1 m"\n'


def scene():
    return load(block("")).with_(SIDEWAYS)


def said(words: str, **wishes) -> bool:
    """Whether one remark of the analysis begins so, and no other has been made."""
    remarks = masonry.limit(scene(), **wishes).remarks
    assert len(remarks) <= 1 and all(remark.startswith(words) for remark in remarks)
    return bool(remarks)


@pytest.mark.parametrize(("fraction", "told"), [(0.0099, False), (0.0101, True)])
def test_a_hundredth_of_the_work_by_sliding_has_a_word(fraction, told, monkeypatch):
    for name, module in list(sys.modules.items()):
        if name.startswith("masonry.limit_analysis") and hasattr(module, "sliding_fraction"):
            monkeypatch.setattr(module, "sliding_fraction", lambda *_: fraction)
    assert said("joints slide in this mechanism") == told


@pytest.mark.parametrize(("gap", "told"), [(0.99e-6, False), (1.01e-6, True)])
def test_a_gap_of_a_millionth_has_a_word(gap, told, monkeypatch):
    solve = analysis.largest_factor
    monkeypatch.setattr(analysis, "largest_factor", lambda *args: replace(solve(*args), gap=gap))
    assert said("the duality gap is more than 1e-06") == told


@pytest.mark.parametrize(("left", "told"), [(0.9951, False), (0.9949, True)])
def test_a_factor_that_falls_by_half_a_per_cent_behind_its_peak_has_a_word(left, told, monkeypatch):
    solve = corner_points.without_dilation

    def fallen(*args) -> Flat:
        flat = solve(*args)
        return replace(flat, end_factor=left * flat.solution.factor)

    monkeypatch.setattr(corner_points, "without_dilation", fallen)
    assert said("what slides loses the pressure that held it", dilation=False) == told


@pytest.mark.parametrize(("least", "told"), [(0.99e-6, 0.0), (1.01e-6, -1.01e-6)])
def test_a_least_force_below_a_millionth_of_the_greatest_is_none(least, told, monkeypatch):
    solve, calls = analysis.largest_factor, []

    def pulled(*args):
        calls.append(solve(*args))
        return replace(calls[-1], factor=least * calls[0].factor) if len(calls) == 2 else calls[-1]

    monkeypatch.setattr(analysis, "largest_factor", pulled)
    drive = '[drive]\non = "block"\ndirection = "x"\ndisplacement = "1 mm"\n'
    result = masonry.limit(load(block(drive)))
    assert result.least == pytest.approx(told * result.factor, rel=1e-9)


@pytest.mark.parametrize(("short", "stands"), [(0.99e-6, True), (1.01e-6, False)])
def test_all_but_a_millionth_of_the_dead_loads_must_be_balanced(short, stands, monkeypatch):
    solve = analysis.standing
    monkeypatch.setattr(analysis, "standing", lambda *args: replace(solve(*args), factor=1.0 - short))
    if stands:
        assert masonry.limit(scene()).factor == pytest.approx(0.5, rel=1e-8)
    else:
        with pytest.raises(SceneError, match="it cannot stand under its dead loads"):
            masonry.limit(scene())


def test_the_first_to_move_is_the_block_that_falls():
    """The upper block stands beyond the edge of the lower one."""
    over = '  {name = "over", origin = ["0.3 m", "0 m", "1 m"], size = ["0.5 m", "0.3 m", "0.2 m"], unit = 2},\n]\n'
    text = block("").replace("]\n[material", over + "[material")
    with pytest.raises(SceneError, match=r"block 2 \('over'\) at \(0\.55, 0\.15, 1\.1\) m is the first to move"):
        masonry.limit(load(text).with_(SIDEWAYS))


@pytest.mark.parametrize(("share", "same"), [(0.989, False), (0.991, True)])
def test_joints_rise_as_in_limit_analysis_from_99_hundredths_of_friction_on(share, same):
    law = FEEBLE + dilating(share)
    dilates = load(block("", law.replace('law = "linear"', 'law = "brittle"')))
    assert rises(dilates, *touching(dilates)) == same


def test_one_joint_that_does_not_rise_is_enough_for_the_word():
    law = FEEBLE.replace('law = "linear"', 'law = "brittle"') + dilating(1.0)
    more = '  {name = "third", origin = ["1 m", "0 m", "0 m"], size = ["0.5 m", "0.3 m", "1 m"], unit = 2, '
    table = '[contact.others_units]\nlaw = "friction"\nnormal_stiffness = "30 GPa/m"\nshear_stiffness = "12 GPa/m"\n'
    table += 'tan_friction_angle = 0.7\n[material.others]\ndensity = "2000 kg/m^3"\n'
    text = block("", law).replace("]\n[material.units", more + 'group = "others"},\n]\n[material.units')
    built = load(text + table)
    assert not rises(built, *touching(built))


@pytest.mark.parametrize(("share", "moves"), [(0.99e-6, False), (1.01e-6, True)])
def test_a_block_moves_from_a_millionth_of_the_fastest_speed_on(share, moves):
    result = masonry.limit(scene())
    result.velocity = np.zeros((2, 6))
    result.velocity[1, 0], result.velocity[0, 0] = 3.0, 3.0 * share
    assert result.moving.tolist() == [moves, True]
    data = json.loads(json.dumps(result.as_data()))
    assert data["mechanism"]["moving_blocks"] == ([0, 1] if moves else [1])
    assert data["mechanism"]["velocity"][1] == [1.0, 0.0, 0.0]
