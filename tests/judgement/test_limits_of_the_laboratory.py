"""When dead loads have settled, cracks have left the symmetry, and what is told of quality and loads: by its limits."""

from collections import defaultdict
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from geometry.blocks import Joints
from masonry.assembly.assemble import Assembly, assemble
from masonry.errors import Stopped
from masonry.judgement.words import percent
from masonry.laboratory import quality, settling_search
from masonry.laboratory.summary.symmetry import symmetry_lost
from masonry.laboratory.text import loads_text
from masonry.model.step_cost import StepCost
from masonry.results.summary import Summary
from masonry.scene import load
from tests.judgement.frames import frame
from tests.scenes import box, tables
from tests.scenes import load as load_text
from tests.scenes import specimen as boxes

GLUE = 'law = "elastic"\nnormal_stiffness = "30 GPa/m"\nshear_stiffness = "12 GPa/m"'


def tried(monkeypatch, assembly: Assembly, unbalanced: list[float], moving: list[float]) -> tuple[list[int], int]:
    """The steps of each trial, and those that were settled on, where the first trial ends with these looks and all
    others are at rest."""
    steps: list[int] = []
    calm = defaultdict(lambda: np.zeros(50))

    def loop(model, plan, trial, *others):
        looks = {"unbalanced": np.array(unbalanced), "still_moving": np.array(moving)}
        seen = calm if steps else defaultdict(lambda: np.zeros(len(unbalanced)), looks)
        steps.append(trial)
        return SimpleNamespace(run=lambda *_: None, observed=seen)

    monkeypatch.setattr(settling_search, "Loop", loop)
    return steps, settling_search.settled(assembly, 1, None, lambda: False).scene.settle.steps


@pytest.mark.parametrize(
    ("unbalanced", "moving", "trials"),
    [
        ([0.99e-4] * 50, [0.99e-8] * 50, [2000]),
        ([1.01e-4] * 50, [0.0] * 50, [2000, 4000]),
        ([0.0] * 50, [1.01e-8] * 50, [2000, 4000]),
        ([1.0] * 45 + [0.0] * 5, [1.0] * 45 + [0.0] * 5, [2000]),
        ([1.0] * 46 + [0.0] * 4, [0.0] * 50, [2000, 4000]),
        ([0.0] * 50, [1.0] * 46 + [0.0] * 4, [2000, 4000]),
    ],
)
def test_dead_loads_have_settled_where_the_last_five_looks_found_all_at_rest(unbalanced, moving, trials, monkeypatch):
    found, steps = tried(monkeypatch, assemble(load("arch").with_({"settle": None})), unbalanced, moving)
    assert (found, steps) == (trials, trials[-1])


def test_trials_end_at_128000_steps(monkeypatch):
    loop = SimpleNamespace(run=lambda *_: None, observed=defaultdict(lambda: np.ones(50)))
    monkeypatch.setattr(settling_search, "Loop", lambda *_: loop)
    with pytest.raises(Stopped, match=r"in 128000 steps: 1 of them are still unbalanced \(should be under 0.0001\)"):
        settling_search.settled(assemble(load("arch").with_({"settle": None})), 1, None, lambda: False)


@pytest.fixture(scope="module")
def row() -> Assembly:
    """Six cubes in a row along x, with five joints of four points."""
    cubes = [box(f"cube {k}", (0.1 * k, 0, 0), (0.1, 0.1, 0.1), "units", k) for k in range(6)]
    held = '[[support]]\non = "cube 0"\nfix = "all"\n[drive]\non = "cube 5"\ndirection = "x"\ndisplacement = "1 um"\n'
    material, contact = {"units": 'density = "2000 kg/m^3"'}, {"unit_unit": GLUE}
    text = boxes(cubes, 0.01) + tables("material", material) + tables("contact", contact) + held
    return assemble(load_text('kinematics = "rigid"\n' + text))


def cracked(row: Assembly, *joints: float) -> np.ndarray:
    """(C,) the damage of the contacts of each joint from left to right."""
    return np.array(joints)[np.argsort(np.argsort(row.joints.point[:, 0], kind="stable")) // 4]


EVEN, ONE = (0.5, 0.0, 0.0, 0.0, 0.5), (0.9, 0.0, 0.0, 0.0, 0.1)


def lost(row: Assembly, *damages: tuple[float, ...], kind: str = "damage_tension", joints: Joints | None = None) -> str:
    """The axis of the symmetry that is lost where the joints are damaged so, frame by frame."""
    return symmetry_lost(
        joints or row.joints, [frame(row, k, **{kind: cracked(row, *d)}) for k, d in enumerate(damages)]
    )


def apart(share: float) -> tuple[float, ...]:
    """The outermost joints are damaged alike, but for this share of their sum."""
    return 0.5 + 0.5 * share, 0.0, 0.0, 0.0, 0.5 - 0.5 * share


@pytest.mark.parametrize(("share", "axis"), [(0.99, ""), (1.01, "x")])
def test_symmetry_is_lost_from_a_tenth_of_the_cracks_on(row, share, axis):
    assert lost(row, EVEN, apart(0.1 * share)) == axis


@pytest.mark.parametrize("kind", ["damage_tension", "damage_shear"])
@pytest.mark.parametrize(("share", "axis"), [(0.99, "x"), (1.01, "")])
def test_cracks_are_symmetric_up_to_a_fiftieth(row, share, axis, kind):
    assert lost(row, apart(0.02 * share), ONE, kind=kind) == axis


@pytest.mark.parametrize(("share", "axis"), [(0.99, ""), (1.01, "x")])
def test_cracks_count_from_a_thousandth_of_the_area_on(row, share, axis):
    least = share * 1e-3 * 5.0 / 2.0
    assert lost(row, (least, 0, 0, 0, least), ONE) == axis


@pytest.mark.parametrize(("share", "axis"), [(0.95, "x"), (1.05, "")])
def test_places_are_mirror_images_within_a_millionth_of_the_size(row, share, axis):
    """0.4 m between the outermost joints; the places that are compared lie half-way to the middles of their joints."""
    point = row.joints.point.copy()
    point[np.argmin(point[:, 0]), 0] -= 2.0 * share * 0.4e-6
    assert lost(row, EVEN, ONE, joints=replace(row.joints, point=point)) == axis


def test_cracks_that_never_were_symmetric_lost_nothing_and_what_comes_back_neither(row):
    for damages in ((ONE, ONE), (EVEN, ONE, EVEN), (EVEN,), (ONE,)):
        assert lost(row, *damages) == ""


@pytest.mark.parametrize(("usual", "said"), [(1.0049, "none: all blocks"), (1.0051, "0.5% longer if no block were")])
def test_a_block_costs_something_from_half_a_per_cent_on(row, usual, said):
    cost = StepCost(block=1, without=1.0, usual=usual)
    assert said in quality._cost(replace(row, model=replace(row.model, cost=cost)))


@pytest.mark.parametrize(("ratio", "words"), [(1.99, "99.0% longer"), (2.0, "2 times as long"), (1.5, "50.0% longer")])
def test_a_longer_step_is_told_in_words(ratio, words):
    assert quality._longer(ratio) == words


def test_the_quality_of_a_row_of_cubes_is_that_of_a_cube(row):
    lines = quality.quality_lines(row)
    assert lines["shortest edge"].startswith("100 mm, 1 h; block ")
    assert lines["smallest block"].startswith("1e+03 cm3, 1 of its group's mean")
    assert lines["shortest joint edge"].startswith("100 mm, 1 h; blocks ")
    assert lines["smallest joint"].startswith("1e+04 mm2, 1 h2")


@pytest.mark.parametrize(("work", "told"), [(0.99, False), (1.01, True), (-0.99, False), (-1.01, True)])
def test_the_work_of_a_load_is_told_from_a_tenth_of_that_of_the_drive_on(work, told):
    told_loads = loads_text(Summary(work_of_drive_j=-10.0, work_of_loads_after_settling_j={"gravity": work}))
    assert bool(told_loads) == told and ("gravity" in told_loads) == told


@pytest.mark.parametrize(
    ("share", "words"),
    [(0.99e-11, "0 %"), (1.01e-11, "1e-09 %"), (-0.99e-5, "0 %"), (-1.01e-5, "-0.001 %"), (0.01234, "1.2 %")],
)
def test_a_share_is_0_where_it_is_rounding(share, words):
    assert percent(share) == words
