"""`masonry picture DIR` and `masonry movie DIR` draw the frames that were asked for, whole files or none."""

import re
import sys
from dataclasses import replace

import numpy as np
import pytest
from matplotlib import image
from PIL import Image

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.laboratory.result import load_result
from masonry.movies import movie_file
from masonry.movies.movie import Movie
from masonry.movies.movie_file import write_movie
from masonry.pictures.crack_picture import drawing_of, frames_to_draw, magnification, panel_title, travelled_fraction
from masonry.pictures.frame_picture import draw_frame
from masonry.results.frame_choice import choose
from masonry.results.store import NUMBERS
from masonry.runtime.folders.own_files import LIST
from tests.results.sample import HEIGHT, LENGTH, sample, with_tets
from tests.results.test_pictures import blue, red


@pytest.fixture
def folder(tmp_path):
    sample().save_numbers(tmp_path / "run")
    return tmp_path / "run"


def new_files(folder):
    return {path.name for path in folder.iterdir()} - {*NUMBERS, LIST}


@pytest.mark.parametrize(
    ("step", "found", "name"),
    [
        ("peak", 200, "at the peak"),
        ("first", 0, "at the start"),
        ("last", 1000, "at the end"),
        ("200", 200, "at step 200"),
        (200, 200, "at step 200"),
        ("601", 1000, "at step 1000, the nearest kept to 601"),
        ("0.04 mm", 200, "at step 200"),
        (4e-5, 200, "at step 200"),
        ("0.05mm", 200, "at step 200, the nearest kept to 0.05mm"),
        ("1 m", 1000, "at step 1000, the nearest kept to 1 m"),
    ],
)
def test_the_frame_is_the_one_asked_for_or_the_nearest_and_says_so(step, found, name):
    chosen = choose(sample(), step)
    assert (chosen.frame.step, chosen.name) == (found, name)
    assert ("solver.frames" in chosen.note) == ("nearest" in name)


@pytest.mark.parametrize("step", ["peek", "", "5", "-1", "3 MPa", "nan mm", float("nan"), None])
def test_a_step_that_is_none_is_refused_in_one_message(step):
    result = sample()
    if step == "5":
        result.history.frames = []
    says = "no frames" if step == "5" else "peak, lowest, last, first, the number of a step"
    with pytest.raises(SceneError, match=says) as refused:
        choose(result, step)
    assert ("did you mean 'peak'" in str(refused.value)) == (step == "peek")


def pulled_then_pressed():
    """The sample, pushed beyond where it began at its end, with a stress larger than its peak."""
    result = sample()
    last = result.history.frames[-1]
    result.history.frames[-1] = replace(last, displacement=-2e-4)
    rows = result.history.rows
    rows["displacement"][60:] = np.linspace(1e-4, -2e-4, 41)
    rows["stress"][60:] = np.linspace(5e4, -6e5, 41)
    return result


def test_the_peak_is_that_of_the_summary_where_the_specimen_bears_more_the_other_way():
    result = pulled_then_pressed()
    assert choose(result, "peak").frame.displacement == result.summary["displacement_at_peak_m"]
    assert [name for name, _ in frames_to_draw(result)] == ["at the peak", "at the end"]


def test_the_lowest_stress_has_a_frame_or_its_nearest_which_says_so():
    result = pulled_then_pressed()
    chosen = choose(result, "lowest")
    assert (chosen.frame.step, chosen.name, chosen.note) == (1000, "at the lowest stress", "")
    result.history.rows["stress"][90] = -7e5
    chosen = choose(result, "lowest")
    assert (chosen.frame.step, chosen.name) == (1000, "nearest kept to the lowest stress")
    assert "lowest stress, -0.7 MPa at step 900; the nearest of 3 is drawn: step 1000" in chosen.note
    with pytest.raises(SceneError, match="no stress below zero"):
        choose(sample(), "lowest")


@pytest.mark.parametrize("step", ["-0.2 mm", "-0.2mm", -2e-4])
def test_a_negative_displacement_can_be_asked_for(step):
    chosen = choose(pulled_then_pressed(), step)
    assert (chosen.frame.step, chosen.note) == (1000, "")


def test_the_pictures_of_both_directions_have_names_of_their_own(folder, capsys):
    assert main(["picture", str(folder), "--step=-0.2mm"]) == main(["picture", str(folder), "--step", "0.2mm"]) == 0
    assert new_files(folder) == {"minus-0.2mm-front.png", "0.2mm-front.png"}


def test_the_share_of_the_way_counts_all_that_the_drive_goes_to_and_fro():
    frame = sample().history.frames[1]
    rows = {"step": 100.0 * np.arange(4), "displacement": np.array([0.0, 1.0, -1.0, 0.0])}
    assert travelled_fraction(rows, frame) == pytest.approx(0.75)
    assert travelled_fraction({**rows, "displacement": np.zeros(4)}, frame) == pytest.approx(2 / 3)


def test_a_title_says_displacement_stress_share_of_the_way_and_scale():
    result = sample()
    words = panel_title(result, "at the peak", result.history.frames[1], 250.0)
    first, second = words.split("\n")
    assert first == "at the peak: displacement 0.04 mm, stress 0.19 MPa"
    assert second == "20 % of the way, displacements drawn 250 times"


def test_the_command_draws_the_peak_beside_the_results_and_says_where(folder, capsys):
    assert main(["picture", str(folder)]) == 0
    assert capsys.readouterr().out.strip() == str(folder / "peak-front.png")
    assert new_files(folder) == {"peak-front.png"}
    assert main(["picture", str(folder), "--step", "0.05 mm", "--view", "iso"]) == 0
    path, note = capsys.readouterr().out.strip().split("\n")
    assert path == str(folder / "0.05-mm-iso.png")
    assert re.fullmatch(r"no frame was kept at '0.05 mm'; the nearest of 3 is drawn: step 200, .*0.04 mm.*", note)


@pytest.mark.parametrize("view", ["front", "back", "iso"])
@pytest.mark.parametrize("make", [sample, lambda: with_tets(sample())], ids=["faces", "tets"])
def test_cracks_are_red_and_blue_in_every_view_and_absent_where_nothing_is_damaged(tmp_path, view, make):
    for step, cracked in (("last", True), ("first", False)):
        draw_frame(make(), tmp_path / "a.png", step, view)
        picture = image.imread(tmp_path / "a.png")[:, :, :3]
        picture = picture[: int(0.8 * len(picture)), : int(0.8 * picture.shape[1])]
        assert (red(picture).sum() > 1000) == cracked and (blue(picture).sum() > 300) == cracked


def test_from_behind_left_and_right_change_places():
    result = sample()
    front, back = (drawing_of(result, view) for view in ("front", "back"))
    points = result.specimen.blocks.points
    np.testing.assert_allclose(front.camera.project(points) * (-1, 1), back.camera.project(points))


def test_a_crack_comes_out_on_the_front_and_on_top_where_its_joint_ends():
    result = sample()
    drawing = drawing_of(result, "iso")
    tile = drawing.tile[drawing.after >= 0]
    assert len(tile) and np.all(np.isclose(tile[:, 1], 0.0) | np.isclose(tile[:, 2], 4 * HEIGHT))
    heads = np.flatnonzero(np.abs(result.joints.normal[:, 0]) > 0.5)
    owner = np.repeat(np.arange(len(result.joints.area)), np.diff(drawing.start))
    following = np.arange(1, len(owner) + 1)
    following[drawing.start[1:] - 1] = drawing.start[:-1]
    length = np.linalg.norm(drawing.tile[following] - drawing.tile, axis=1)
    seen = np.isin(owner, heads) & (drawing.after >= 0)
    on_top = seen & np.isclose(drawing.tile[:, 2], 4 * HEIGHT) & np.isclose(drawing.tile[following, 2], 4 * HEIGHT)
    middle = np.isclose(drawing.tile[:, 0], LENGTH)
    assert length[seen & ~on_top & middle].sum() == pytest.approx(4 * HEIGHT), "every course, as joint or within a unit"
    assert length[on_top & middle].sum() == pytest.approx(0.05), "the thickness of the wall"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["picture", "couplet"], "'couplet' is not a folder of results.*add --geometry"),
        (["picture", "{run}", "--geometry"], "is a folder.*scene.toml --geometry"),
        (["picture", "{run}", "--set", "law=linear"], "--set changes a scene"),
        (["picture", "{run}", "--step", "peek"], "step 'peek'.*did you mean 'peak'"),
        (["picture", "{run}", "--step", "2 s"], "step '2 s': this run is not in real time"),
        (["picture", "{run}", "--scale", "-3"], "'-3' is not a number from 0"),
        (["picture", "{run}", "--view", "top"], "invalid choice: 'top'"),
        (["picture", "{run}", "--out", "wall.svgz"], "a .png, .pdf or .svg file; nearest: 'wall.svg'"),
        (["picture", "."], "'.' has no summary.json"),
        (["picture", "couplet", "--geometry", "--step", "peak"], "--step is for a folder of results"),
        (["picture", "couplet", "--geometry", "--scale", "2"], "--scale is for a folder of results"),
        (["movie", "nowhere"], "'nowhere' is not a folder of results"),
        (["movie", "{run}", "--to", "wall.avi"], "a .gif or .mp4 file; nearest: 'wall.gif'"),
        (["movie", "{run}", "--fps", "0"], "1 to 60"),
        (["movie", "{run}", "--to", "no/such/wall.gif"], "cannot write"),
    ],
)
def test_what_does_not_fit_ends_with_code_2_one_message_and_no_file(folder, capsys, monkeypatch, words, says):
    monkeypatch.chdir(folder.parent)
    assert main([word.format(run=folder) for word in words]) == 2
    complaint = capsys.readouterr().err.strip().split("\n")[-1]
    assert re.search(says, complaint)
    assert new_files(folder) == set() and [path.name for path in folder.parent.iterdir()] == ["run"]


def test_a_movie_has_every_frame_and_keeps_its_scales(tmp_path):
    result = sample()
    movie, limits, places = Movie(result), [], []
    assert movie.times == magnification(result.history.frames[-1], movie.drawing.camera.size), "of what moves most"
    for number in range(3):
        movie.draw(number)
        limits.append((movie.panel.get_xlim(), movie.panel.get_ylim()))
        ((_, _, dot),) = movie.moving
        places.append((dot.get_xdata()[0], dot.get_ydata()[0]))
    assert limits[0] == limits[1] == limits[2]
    np.testing.assert_allclose(places, [(0.0, 0.0), (0.04, 0.19), (0.2, 0.19 * np.exp(-3.2))])
    assert "1 of 3" not in movie.panel.get_title() and "3 of 3: displacement 0.2 mm" in movie.panel.get_title()


def test_a_gif_opens_with_cracks_in_its_last_frame_only_and_the_last_one_stays(folder):
    assert main(["movie", str(folder), "--fps", "10"]) == 0
    assert new_files(folder) == {"movie.gif"}
    with Image.open(folder / "movie.gif") as movie:
        assert movie.n_frames == 3
        shares, times = [], []
        for number in range(3):
            movie.seek(number)
            times.append(movie.info["duration"])
            picture = np.asarray(movie.convert("RGB")) / 255.0
            shares.append(int(red(picture[: int(0.8 * len(picture)), : int(0.45 * picture.shape[1])]).sum()))
    assert shares[0] < 20 and shares[2] > 500
    assert times[:2] == [100, 100] and times[2] > 1000


def test_an_mp4_is_written_where_there_is_an_ffmpeg_and_refused_in_one_message_elsewhere(tmp_path, monkeypatch):
    frames = pytest.importorskip("imageio_ffmpeg")
    path = write_movie(sample(), tmp_path / "wall.mp4", fps=2)
    assert path.read_bytes()[4:8] == b"ftyp"
    assert frames.count_frames_and_secs(str(path))[0] == 3 + 3
    monkeypatch.setattr(movie_file.shutil, "which", lambda name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(SceneError, match=r"pip install '\.\[movie\]'"):
        write_movie(sample(), tmp_path / "other.mp4")
    assert [path.name for path in tmp_path.iterdir()] == ["wall.mp4"]


def test_a_movie_that_is_broken_off_leaves_the_old_one(folder, monkeypatch):
    (folder / "movie.gif").write_bytes(b"old")

    def stop(*arguments):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_movie(load_result(folder), folder / "movie.gif", progress=stop)
    assert new_files(folder) == {"movie.gif"} and (folder / "movie.gif").read_bytes() == b"old"
