"""Records of many formats are read right, or refused by name: one shock, written after public descriptions of each."""

import re

import numpy as np
import pytest

from masonry import load
from masonry.errors import SceneError
from masonry.ground.ground_motion import from_displacement
from masonry.ground.records.line_order import goes_on_from_line_to_line
from masonry.ground.records.reading import read_record
from masonry.laboratory.remarks.scenes.noisy_records import LIMIT, peak_of_every_second_sample
from masonry.scene.tables.dynamics.ground import Ground
from tests.ground.record_files import (
    COUNT,
    GAL,
    IN_G,
    SHOCK,
    STEP,
    Written,
    foreign,
    lines_of,
    of_dyna,
    of_knet,
    readable,
)

FILES = {written.name: written for written in readable()}
FOREIGN = foreign()


def read(folder, written: Written, **more: str):
    """The time and the samples (SI) that a scene has of a file."""
    path = folder / written.name
    path.write_bytes(written.text if isinstance(written.text, bytes) else written.text.encode())
    keys = written.keys | more
    record = read_record(path)
    step = None if "step" not in keys else float(keys["step"].removesuffix(" s"))
    quantity = keys.get("quantity", "acceleration")
    return record.time(keys.get("time"), step), record.samples(keys["x"], quantity, keys.get("unit"))


@pytest.mark.parametrize("name", FILES)
def test_a_record_of_each_format_is_read_as_it_was_written(tmp_path, name):
    written = FILES[name]
    time, values = read(tmp_path, written)
    assert len(values) == len(written.right) and time == pytest.approx(STEP * np.arange(len(values)))
    assert np.abs(values - written.right).max() < written.digit


@pytest.mark.parametrize("name", FOREIGN)
def test_a_format_that_is_not_read_is_refused_by_its_name_and_with_a_way_on(tmp_path, name):
    what, text = FOREIGN[name]
    (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(SceneError, match=re.escape(what)) as error:
        read_record(tmp_path / name)
    assert len(error.value.lines) == 1
    assert any(way in str(error.value) for way in ("below a line 'NPTS= ", "numpy.savetxt('record.csv'", "unpack it"))


def test_forty_files_of_twelve_formats_are_asked():
    assert len(FILES) + len(FOREIGN) >= 40


@pytest.mark.parametrize("name", [name for name, written in FILES.items() if "step" not in written.keys])
def test_a_step_that_contradicts_the_file_is_told_for_every_format(tmp_path, name):
    for step in ("0.01 s", "0.00502 s"):
        with pytest.raises(SceneError, match=r"says that its step is 0\.005 s, and not 0\.0.*: leave ground\.step out"):
            read(tmp_path, FILES[name], step=step)
    read(tmp_path, FILES[name], step="0.005 s")


@pytest.mark.parametrize("name", [name for name, written in FILES.items() if "unit" not in written.keys])
def test_a_unit_that_contradicts_the_file_is_told_for_every_format(tmp_path, name):
    unit = "mm/s" if "quantity" in FILES[name].keys else "mm/s2"
    with pytest.raises(SceneError, match=rf"unit = '{unit}', but '{re.escape(name)}' says that .* is in"):
        read(tmp_path, FILES[name], unit=unit)


SAYS_SAMPLES = [
    name
    for name, written in FILES.items()
    if isinstance(written.text, str) and re.search(r"NPTS|NDATA|[Nn]umber of|NUMBER OF|Duration", written.text)
]


@pytest.mark.parametrize("name", SAYS_SAMPLES)
def test_samples_that_are_missing_are_told_for_every_format_that_says_how_many_there_are(tmp_path, name):
    lines = FILES[name].text.splitlines(keepends=True)
    del lines[-20]
    with pytest.raises(SceneError, match="says that it has 397 samples, and 3.* follow: it is cut off"):
        read(tmp_path, FILES[name]._replace(text="".join(lines)))


def ground(folder, name: str, **keys: str) -> Ground:
    """The table [ground] of a scene that reads a file."""
    written = FILES[name]
    path = folder / name
    path.write_bytes(written.text if isinstance(written.text, bytes) else written.text.encode())
    return Ground(record=str(path), **(written.keys | keys))


def test_a_column_of_times_is_no_motion(tmp_path):
    for keys in ({"x": "1"}, {"x": "1", "step": "0.005 s"}):
        with pytest.raises(SceneError, match="x = '1' is the column of the times"):
            _ = ground(tmp_path, "alone.txt", **keys).motions


def test_numbers_that_may_be_columns_or_one_record_are_asked_for_a_name(tmp_path):
    """White noise looks the same either way."""
    noise = np.random.default_rng(5).normal(size=400)
    written = Written(
        "noise.txt", lines_of(noise, "%10.5f", 4), {"x": "1", "unit": "g", "step": "0.005 s"}, 9.80665 * noise
    )
    with pytest.raises(SceneError, match="4 columns without names: is it one record that goes on") as error:
        read(tmp_path, written)
    line = re.search("'(NPTS= .*? SEC)'", str(error.value))[1]
    for above, right in ((line, 9.80665 * noise), ("a (g) b (g) c (g) d (g)", 9.80665 * noise[::4])):
        time, values = read(tmp_path, written._replace(text=f"{above}\n{written.text}", keys=written.keys | {"x": "1"}))
        assert values == pytest.approx(right, abs=1e-4) and time[1] == STEP


def test_a_title_of_as_many_words_as_a_line_has_numbers_is_no_line_of_names(tmp_path):
    five = FILES["five.g3"]
    with pytest.raises(SceneError, match="5 columns below what may be a title or names: is it one record"):
        read(tmp_path, five._replace(text="A town in May 1995\n" + lines_of(IN_G[:395], "%12.6f", 5)))


@pytest.mark.parametrize("width", [2, 3, 5, 8])
def test_records_beside_each_other_are_told_from_one_that_goes_on(width):
    rows = 8 * (COUNT // 8) // width
    assert goes_on_from_line_to_line(SHOCK[: rows * width].reshape(rows, width)) is True
    delayed = np.column_stack([np.roll(SHOCK, 37 * k) * (1.0 + 0.3 * k) for k in range(width)])
    assert goes_on_from_line_to_line(delayed) is False
    alike = np.column_stack([SHOCK * (1.0 + 0.01 * k) for k in range(width)])
    assert goes_on_from_line_to_line(alike) is False
    assert goes_on_from_line_to_line(np.column_stack([STEP * np.arange(COUNT), alike])) is False


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("NPTS= 3, DT= 1.2.3\n1.0 2.0 3.0", "'1.2.3' is no number of a file of PEER"),
        ("3 . NPTS, DT\n1.0 2.0 3.0", "'3 . NPTS, DT' is no number of a file of PEER"),
        (of_knet("N-S", 8388608).replace("/8388608", "/0"), "'Scale Factor' is '0', which is no number above 0"),
        (of_knet("N-S", 8388608).replace("2000(gal)/8388608", "2000"), "'Scale Factor' is '2000', and not as"),
        (of_knet("N-S", 8388608).replace("200Hz", "fast"), "'Sampling Freq.Hz.' is 'fast'"),
        (
            of_dyna("ACCELERATION", "cm/s^2").replace("0.005000", "1e-300"),
            "a step of 1e-300 s from sample to",
        ),
        (of_dyna("ACCELERATION", "cm/s^2").replace("0.005000", "-0.005"), "'SAMPLING_INTERVAL_S' is '-0.005'"),
        (of_dyna("PSEUDO-ACCELERATION SPECTRUM", "cm/s^2"), "holds 'PSEUDO-ACCELERATION SPECTRUM', and no motion"),
        (of_dyna("VELOCITY", "cm/s"), "'cm/s' is the unit of a velocity, .* is quantity = 'velocity' meant"),
        (
            "NPTS= 397, DT= 1e-300\n" + lines_of(IN_G, "%10.6f", 5),
            "a step of 1e-300 s from sample to",
        ),
        ("NPTS= 397, DT= 0.005\nTime step: 0.01\n" + lines_of(IN_G, "%10.6f", 5), "says 0.005 and 0.01 s from sample"),
        ("NPTS= 396, DT= .005\n" + lines_of(IN_G, "%10.6f", 5), "says that it has 396 samples, and 397 numbers follow"),
        ("NPTS= 394, DT= .005\n" + lines_of(IN_G, "%10.6f", 5), "says that it has 394 samples, and 397 numbers follow"),
        ("NPTS= 3, DT= .005\n1.0 2.0 1_0.0\n", "'1_0.0' is no number of a file of PEER"),
        ("NPTS= 3, DT= .005\n1.0 2.0 inf\n", "'inf' is no number of a file of PEER"),
        ("NPTS= 3, DT= .005\n1.0 2.0 " + "1" * 5000, "'1{40}' is no number of a file of PEER"),
        ("NPTS= " + "1" * 5000 + ", DT= .005\n1.0 2.0 3.0", "NPTS= 1{34}. is no number of a file of PEER"),
        ('time (s),x (g)\n0.0,1\n0.1,"0.1\n0.2,1\n', "row 2 of the numbers: .*0.1' is not a finite number"),
        ("time (s),x (g)\n0.0,1\n0.1,1_0.0\n0.2,1\n", "row 2 of the numbers: '1_0.0' is not a finite number"),
        ("time (s),x (g)\n0.0,1\n0.1,Infinity\n0.2,1\n", "row 2 of the numbers: 'Infinity' is not a finite number"),
        ("time (s),x (g)\n0.0,1\n0.1,٣\n0.2,1\n", "row 2 of the numbers: '٣' is not a finite number"),
        ("time (s),x (g)\n0.0,1\n0.1," + "9" * 5000 + "\n0.2,1\n", "row 2 of the numbers: '9{40}' is not a finite"),
        ('time (s),x (g)\n0.0,1\n0.1,"' + "9" * 140_000 + '"\n0.2,1\n', "row 2 of the numbers: .* is not a finite"),
        ("time (s),x (g)\n0.0,1\n1e-300,1\n2e-300,1\n", "a step of 1e-300 s from sample to sample; allowed"),
        ("1 2\n" * 3 + "a" * 300_000, "line 4: 300000 letters; at most 200000 are allowed"),
    ],
)
def test_what_is_wrong_with_a_file_is_said_in_a_sentence(tmp_path, text, says):
    with pytest.raises(SceneError, match=says) as error:
        read(tmp_path, Written("own.txt", text, {"x": "1"}))
    assert len(error.value.lines) == 1 and len(str(error.value)) < 400


@pytest.mark.parametrize(
    "line", ["a (" * 60_000, "(" * 190_000, "a " * 90_000, '"' * 190_000, "a" + " " * 190_000 + "b"]
)
def test_a_long_line_costs_its_length_and_not_its_square(tmp_path, line):
    """The square of these takes minutes; the limit of the test is that of a hang."""
    written = Written("own.txt", f"{line}\ntime (s) x (g)\n0.0 1\n0.1 2\n0.2 1\n", {"x": "x"})
    assert read(tmp_path, written)[1] == pytest.approx([9.80665, 19.6133, 9.80665])


def test_a_scene_shakes_with_the_file_of_a_network(tmp_path):
    """Counts of K-NET come to the ground as the accelerations of the head's scale, less their mean."""
    (tmp_path / "own.NS").write_text(FILES["own.NS"].text)
    scene = load("block-shaken", {"ground": {"record": str(tmp_path / "own.NS"), "x": "1"}})
    motion = scene.ground[0].motions["x"]
    assert motion.acceleration == pytest.approx(SHOCK - SHOCK.mean(), abs=1e-4)
    assert motion.duration == pytest.approx(STEP * (COUNT - 1)) and GAL.max() > 100.0


@pytest.mark.parametrize(
    ("digit", "rate", "told"), [(1e-5, 1000.0, True), (1e-5, 100.0, False), (1e-8, 1000.0, False), (0.0, 60.0, False)]
)
def test_a_displacement_whose_differences_are_noise_is_told(digit, rate, told):
    """0.01 mm at 1 kHz: 0.6 g are read as several g; a digit less or a tenth of the rate leave the motion."""
    time = np.arange(round(2.0 * rate) + 1) / rate
    place = 0.02 * (1.0 - np.cos(2.0 * np.pi * np.minimum(time, 1.0))) ** 2 * (1.0 + 0.3 * time)
    motion = from_displacement(time, np.round(place / digit) * digit if digit else place)
    ratio = motion.peak_acceleration / peak_of_every_second_sample(motion, "displacement", rate)
    assert (ratio > LIMIT) == told
