"""Pictures and movies of a motion in real time: drawn over the time, which titles say, and asked for by it."""

import numpy as np
import pytest

from masonry.errors import SceneError
from masonry.movies.movie import Movie
from masonry.pictures.crack_picture import panel_title
from masonry.results.frame_choice import choose
from tests.results.sample import sample
from tests.results.test_pictures import resting


def falling(**gauges):
    """The same as a motion in real time: the sample has 0.1 ms a step."""
    result = resting(**gauges)
    result.summary |= {"in_real_time": True}
    return result


def test_a_motion_in_real_time_is_drawn_over_the_time_and_its_titles_say_it():
    result = falling()
    moved, ledger = result.plot().axes
    assert ledger.get_xlabel() == "time from the first step [s]"
    assert moved.get_lines()[0].get_xdata() == pytest.approx([0.0, *(frame.time for frame in result.history.frames)])
    (title,) = [axes.get_title() for axes in result.picture().axes if axes.get_title()]
    assert title.startswith("at the end: after 0.1 s\ndisplacements drawn ")
    driven = sample()
    driven.summary |= {"in_real_time": True}
    title = panel_title(driven, "at the peak", driven.history.frames[1], 1.0)
    assert title == "at the peak: displacement 0.04 mm, stress 0.19 MPa\nafter 0.02 s, drawn at true scale"


def tilted(sign):
    """A motion under gravity that is turned by up to 0.4 rad in half of its time."""
    result = falling()
    rows = result.history.rows
    rows["tilt_of_gravity"] = sign * np.minimum(0.8 * rows["step"] / 1000.0, 0.4)
    result.scene_toml = '[curve]\nx = "tilt_of_gravity"\n'
    return result


@pytest.mark.parametrize(("sign", "label"), [(1.0, "tilt of gravity [deg]"), (-1.0, "tilt of gravity, times -1 [deg]")])
def test_a_tilt_is_drawn_to_the_right_whichever_way_gravity_turns(sign, label):
    moved, ledger = tilted(sign).plot().axes
    across = moved.get_lines()[0].get_xdata()
    assert ledger.get_xlabel() == label and across[0] == 0.0 and across[-1] == pytest.approx(np.degrees(0.4))


def test_what_fell_under_a_tilt_is_drawn_over_the_time_with_its_fall_marked():
    result = tilted(-1.0)
    began = {"step": 300, "time_s": 0.03, "displacement_m": 0.0, "tilt_rad": -0.24}
    result.summary |= {"collapse": {"step": 600, "began": began}}
    moved, ledger = result.plot().axes
    assert ledger.get_xlabel() == "time from the first step [s]"
    marks = {line.get_label(): line.get_xdata()[0] for line in moved.get_lines()[1:]}
    assert marks == {"the fall begins, at -13.75 deg": pytest.approx(0.03), "a block has fallen": pytest.approx(0.06)}
    ((path, _, _),) = Movie(result).moving
    assert path.across[-1] == pytest.approx(0.1)


@pytest.mark.parametrize(("share", "drawn"), [(0.1, True), (1e-5, False)])
def test_what_large_displacement_loses_leaves_no_gap_in_the_ledger(share, drawn):
    result = falling()
    rows = result.history.rows
    work = rows["external_work"]
    rows |= {"area": 0.5 * share * work, "redetection": 0.5 * share * work, "rotor": 0.0 * work, "dashpot": 0.2 * work}
    kept = 1.0 - 0.2 - share
    for name in ("elastic_blocks", "elastic_contacts", "fracture_mode_1", "fracture_mode_2", "friction", "damping"):
        rows[name] = kept * rows[name]
    ledger = result.plot().axes[1]
    labels = [text.get_text() for text in ledger.get_legend().get_texts()]
    assert "dashpots" in labels and ("contacts found anew, turning" in labels) == drawn
    top = max(area.get_paths()[0].vertices[:, 1].max() for area in ledger.collections)
    assert top == pytest.approx(work.max(), rel=2e-5)


@pytest.mark.parametrize(("make", "when"), [(falling, "after 0.02 s"), (resting, "step 200")])
def test_a_title_says_nothing_twice(make, when):
    result = make()
    chosen = choose(result, "200")
    assert panel_title(result, chosen.name, chosen.frame, 1.0).count(when) == 1


@pytest.mark.parametrize(
    ("step", "found", "name"),
    [
        ("0.02 s", 200, "after 0.02 s"),
        ("20 ms", 200, "after 0.02 s"),
        ("200", 200, "after 0.02 s"),
        ("0.07 s", 1000, "after 0.1 s, the nearest kept to 0.07 s"),
        ("900", 1000, "after 0.1 s, the nearest kept to step 900"),
    ],
)
def test_a_run_in_real_time_may_be_asked_for_a_time(step, found, name):
    chosen = choose(falling(), step)
    assert (chosen.frame.step, chosen.name) == (found, name)
    assert ("step 1000, after 0.1 s (a run keeps more" in chosen.note) == ("nearest" in name)


@pytest.mark.parametrize(
    ("make", "step", "says"),
    [
        (sample, "2 s", "not in real time, so it has no times; .*a displacement such as '0.05 mm'"),
        (falling, "0.05 mm", "nothing is driven in this run.*the number of a step, or a time such as '1.2 s'"),
        (falling, 5e-5, "nothing is driven in this run"),
        (resting, "0.05 mm", "nothing is driven in this run.*first, or the number of a step"),
    ],
)
def test_what_a_run_has_not_is_refused_and_what_it_has_is_named(make, step, says):
    with pytest.raises(SceneError, match=says):
        choose(make(), step)


def test_a_movie_of_a_scene_without_a_drive_shows_what_its_curve_shows_over_the_time():
    sway = np.linspace(0.0, -2e-4, len(sample().history.rows["step"]))
    result = falling(sway=sway)
    movie = Movie(result)
    ((path, passed, dot),) = movie.moving
    (drawn,) = result.plot().axes[0].get_lines()
    np.testing.assert_array_equal(np.stack([path.across, path.up]), drawn.get_data())
    assert passed.get_label() == "sway"
    axes = movie.figure.axes[1]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time from the first step [s]", "displacement [mm]")
    movie.draw(1)
    assert (dot.get_xdata()[0], dot.get_ydata()[0]) == pytest.approx((0.02, -0.04))
    assert movie.panel.get_title().startswith("frame 2 of 3: after 0.02 s\n")
