"""What people write as on another system, or by habit, is told with what to write in its place."""

import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.quantity import parse
from masonry.scene import load

VEHICLE = {"on": "all", "level": "20 m", "axles": ["25 t"], "position": "1 m"}


def scene(folder, text):
    (folder / "own.toml").write_text(f'base = "couplet"\n{text}\n', encoding="utf-8")
    return load(folder / "own.toml")


@pytest.mark.parametrize(
    ("text", "kind", "says"),
    [
        ("25 t", "force", "'25 t' tells by mass what axles tells by force: its weight is '245166 N'"),
        ("1.7 kg/cm^2", "stress", "its weight is '166713 Pa'"),
        ("3 m", "force", "m is a length; axles is a force"),
    ],
)
def test_a_mass_where_a_force_belongs_is_told_as_its_weight(text, kind, says):
    with pytest.raises(SceneError, match=says) as said:
        parse(text, kind, "vehicle.axles")
    if "its weight is" in says:
        weight = text.replace(" t", " tf").replace("kg", "kgf")
        told = parse(str(said.value).split("'")[-2], kind, "again")
        assert told == pytest.approx(parse(weight, kind, "again"), rel=1e-5)


def test_axles_in_tonnes_are_told_their_weight():
    with pytest.raises(SceneError, match="vehicle.axles.0: '25 t' tells by mass what .* its weight is '245166 N'"):
        load("couplet", {"vehicle": VEHICLE, "limit": {"pattern": "vehicle"}})


def test_back_slashes_in_paths_are_told(tmp_path):
    (tmp_path / "walls").mkdir()
    (tmp_path / "walls" / "test.csv").write_text("a (mm),b (kN)\n0,1\n1,2\n2,3\n")
    measured = "[curve]\nmeasured = {}\n"
    for path, says in (
        ('"C:\\walls.csv"', "write '/' between folders"),
        ('"walls\\test.csv"', "is no path: a back slash begins an escape in double quotes: write '/'"),
        ("'walls\\test.csv'", "but 'walls/test.csv': write '/' between folders"),
        ("'walls\\none.csv'", "none.csv"),
    ):
        with pytest.raises(SceneError, match=says):
            scene(tmp_path, measured.format(path))
    assert scene(tmp_path, measured.format('"walls/test.csv"')).curve.measured == str(tmp_path / "walls" / "test.csv")
    (tmp_path / "walls" / "base.toml").write_text('base = "couplet"\n')
    (tmp_path / "own.toml").write_text("base = 'walls\\base.toml'\n")
    with pytest.raises(SceneError, match="did you mean 'walls/base.toml'"):
        load(tmp_path / "own.toml")


@pytest.mark.parametrize(
    "tables",
    [
        {"vehicle": VEHICLE | {"on": "nope", "axles": ["250 kN"]}, "limit": {"pattern": "vehicle", "accuracy": "none"}},
        {"limit": {"pattern": "force", "on": "nope", "force": {"x": "1 kN"}}},
        {"limit": {"pattern": "traction", "on": "nope.z+", "stress": {"x": "1 Pa"}}},
    ],
)
def test_what_masonry_limit_alone_loads_must_be_there_for_a_check_too(tables):
    (key,) = (name for name, table in tables.items() if "on" in table)
    known = "bottom, top, units" if key == "vehicle" else ".*'bottom.z"  # a vehicle drives on whole blocks
    with pytest.raises(SceneError, match=f"{key}.on = 'nope.*' selects nothing; known here: {known}"):
        assemble(load("couplet", tables))
