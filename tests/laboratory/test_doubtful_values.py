"""Unit weights, values that no masonry has, and a record that shakes too hard: each is told with its key and value."""

import math

import numpy as np
import pytest

import masonry
from masonry.cli.main import main
from masonry.laboratory.remarks.scenes.shaken_drive import accelerations
from masonry.scene import load, to_toml

G = 9.80665


@pytest.mark.parametrize("text", ["18 kN/m^3", "18000 N/m3", "18 kN m^-3", "0.018 MN/m³"])
def test_a_unit_weight_is_divided_by_gravity_and_the_scene_says_so(text, tmp_path, capsys):
    scene = load("couplet", {"material.units.density": text})
    assert scene.material["units"].density == pytest.approx(18_000 / G, rel=1e-15)
    assert f"{scene.material['units'].density:.0f}" == "1835"
    assert "is a unit weight" in scene.assumptions["material.units.density"]
    (tmp_path / "again.toml").write_text(to_toml(scene))
    assert load(tmp_path / "again.toml") == scene
    assert main(["check", "couplet", "--set", f"material.units.density={text}"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert f"; {text} is a unit weight: divided by the standard gravity, 9.80665 m/s^2; this is 1835 kg/m3" in said


def test_weight_under_gravity_is_that_of_the_unit_weight():
    """A block of 0.1 m3 weighs 1.8 kN."""
    keys = {"gravity": {"z": f"-{G} m/s^2"}, "material.units.density": "18 kN/m^3"}
    scene = load("couplet", keys)
    assert scene.material["units"].density * G * 0.1 == pytest.approx(1800.0, rel=1e-15)


def test_a_density_set_anew_is_no_unit_weight_any_more_and_one_of_a_fill_is_told():
    scene = load("couplet", {"material.units.density": "18 kN/m^3"})
    anew = scene.with_({"material.units.density": "1900 kg/m^3"})
    assert "unit weight" not in anew.assumptions["material.units.density"]
    fill = [{"on": "voussoirs", "level": "2.1 m", "density": "16 kN/m^3"}]
    arch = load("arch-own-weight", {"fill": fill})
    assert "unit weight" in arch.assumptions["fill.0.density"]
    assert any("fill.0.density" in line and "1632 kg/m3" in line for line in masonry.check(arch)["warnings"])


@pytest.mark.parametrize("text", ["18 kN/m^2", "18 N", "18 kPa", "18 m/s^2"])
def test_what_is_neither_is_refused(text):
    with pytest.raises(masonry.errors.SceneError, match="density is a density"):
        load("couplet", {"material.units.density": text})


def told(scene: str, keys: dict, *words: str) -> bool:
    """Whether one warning of a check has all the words."""
    return any(all(word in line for word in words) for line in masonry.check(load(scene, keys))["warnings"])


TILT = "arch-tilted"
ABSURD = [
    ("couplet", "material.units.density", "{} kg/m^3", 30_000.0),
    (TILT, "contact.unit_unit.tan_friction_angle", "{}", 10.0),
    (TILT, "contact.unit_unit.friction_angle", "{} deg", math.degrees(math.atan(10.0))),
    ("couplet", "drive.rate", "{} m/s", 100.0),
]


@pytest.mark.parametrize(("scene", "key", "text", "most"), ABSURD)
def test_a_value_that_no_masonry_has_is_told_with_its_key_beyond_its_limit_only(scene, key, text, most):
    others = {"drive.steps": None, "drive.accuracy": None} if key == "drive.rate" else {}
    group = key.split(".")[1]
    if "friction" in key:
        contact = masonry.load(scene).resolved()["contact"]
        group = next(iter(contact))
        key = key.replace("unit_unit", group)
        others = {f"contact.{group}.{name}": None for name in ("friction_angle", "tan_friction_angle")}
        others.pop(key)
    assert told(scene, others | {key: text.format(1.001 * most)}, f"{key} = ")
    assert not told(scene, others | {key: text.format(0.999 * most)}, f"{key} = ")


def test_a_velocity_beyond_all_measure_is_told():
    motion = {"on": "block", "velocity": ["60 m/s", "0 m/s", "-80.1 m/s"]}
    scene = load("block-rocking")
    on = scene.motion[0].on if scene.motion else next(iter(scene.material))
    assert told("block-rocking", {"motion": [motion | {"on": on}]}, "motion.0.velocity = 100.1 m/s")


def test_blocks_a_million_times_apart_are_told_with_both_and_the_floor_is_none_of_them():

    def remarks(small: str) -> list[str]:
        box = [
            {"name": "block", "origin": ["0 m", "0 m", "0 m"], "size": ["1 m", "1 m", "1 m"]},
            {"name": "small", "origin": ["0 m", "0 m", "1 m"], "size": [small, small, small]},
        ]
        floor = {"floor.size": ["1 km", "1 km"], "floor.thickness": "1 km"}
        contact = load("block-rocking").resolved()["contact"]["floor_units"]
        keys = {"specimen.box": box, "specimen.turned": None, "contact.default": contact}
        report = masonry.check(load("block-rocking", keys | floor))
        return [line for line in report["warnings"] if line.startswith("specimen: ")]

    assert remarks("10.03 mm") == []
    (line,) = remarks("9.97 mm")
    assert "block 0 has 1 m3, block 1 9.91e-07 m3, 1e+06 times less" in line


def test_the_accelerations_of_a_spline_that_turns_at_each_row_are_three_times_those_of_the_rows():
    """Through rows that go to and fro by d it accelerates by 6 d / h^2; their second difference is 2 d / h^2."""
    place = np.tile([0.0, 0.02], 20)
    place[:10] *= np.arange(10) / 10
    place[-10:] *= np.arange(10)[::-1] / 10
    made, meant = accelerations(np.column_stack([0.1 * np.arange(40), place]))
    assert made == pytest.approx(6 * 0.02 / 0.1**2, rel=0.02) and meant == pytest.approx(2 * 0.02 / 0.1**2, rel=1e-12)


def test_rows_that_lie_close_and_begin_slowly_accelerate_as_they_say():
    time = 0.02 * np.arange(200)
    made, meant = accelerations(np.column_stack([time, 0.01 * np.sin(6.0 * time) * np.sin(np.pi * time / 3.98) ** 2]))
    assert made == pytest.approx(meant, rel=0.01)


RECORD = [[f"{0.02 * k} s", f"{2.0 * math.sin(7.0 * k) * min(k, 5)} mm"] for k in range(60)]


def test_a_record_on_a_drive_in_real_time_is_doubted_with_both_accelerations(tmp_path):
    scene = load("block-rocking").resolved()
    on = next(iter(scene["material"]))
    keys = {"drive": {"on": on, "direction": "x", "history": RECORD}}
    (line,) = [w for w in masonry.check(load("block-rocking", keys))["warnings"] if w.startswith("drive.history")]
    table = np.array([[0.02 * k, 2e-3 * math.sin(7.0 * k) * min(k, 5)] for k in range(60)])
    made, meant = accelerations(table)
    assert f"{made:.3g} m/s2" in line and f"{meant:.3g} m/s2" in line and made > 1.2 * meant
    slow = {
        "drive": {"on": on, "direction": "x", "history": [[f"{5.0 * k} s", row[1]] for k, row in enumerate(RECORD)]}
    }
    assert not told("block-rocking", slow | {"solver.duration": "300 s"}, "drive.history")
    smooth = {"on": on, "direction": "x", "history": "2 mm * sin(2 pi t / 0.1 s)", "duration": "1 s"}
    assert not told("block-rocking", {"drive": smooth}, "drive.history")


def test_a_scaled_run_is_never_shaken():
    history = {"drive.displacement": None, "drive.accuracy": None, "drive.rate": None, "drive.steps": 4000}
    assert not told("couplet", history | {"drive.history": RECORD}, "drive.history")
