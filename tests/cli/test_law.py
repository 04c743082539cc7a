"""`masonry law`: the list, the parameters and measured energies, the picture; for laws of ours and of others."""

import re

import numpy as np
import pytest
from matplotlib.image import imread

from masonry.cli.main import main
from masonry.drawings import law_portrait, law_report
from masonry.drawings.law_picture import law_figure
from masonry.drawings.law_portrait import COMPRESSIONS, portrait
from masonry.errors import SceneError
from masonry.laws.building.factory import build
from masonry.scene.tables.contact_group import Contact
from tests.laws.own_package import files_of_page, install, on_the_path
from verification.fixtures.one_contact import law
from verification.references import closed_forms
from verification.references.closed_forms import Joint


@pytest.fixture
def package(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with on_the_path(install(tmp_path / "package")):
        yield


def said(capsys, *words: str) -> str:
    assert main(["law", *words]) == 0
    return capsys.readouterr().out


def test_the_list_names_every_law_and_where_it_comes_from(package, capsys):
    rows = [re.split(r"\s{2,}", line)[:2] for line in said(capsys).splitlines()]
    ours = ("brittle", "elastic", "exponential", "friction", "linear", "polynomial")
    assert rows == [*([name, "masonry"] for name in ours), ["bilinear", "my-masonry 0.1"]]


def test_a_law_that_does_not_work_is_marked_in_the_list(tmp_path, capsys):
    files = files_of_page() | {"bilinear.py": "import numbat\n"}
    with on_the_path(install(tmp_path / "broken", files)):
        assert re.search(r"^bilinear .*DOES NOT WORK: .*numbat", said(capsys), re.MULTILINE)


def test_parameters_have_units_and_energies_are_measured_against_those_given(package, capsys):
    text = said(capsys, "bilinear", "--set", "fracture_energy_mode_1=12 N/m", "--set", "cohesion=1 MPa")
    for words in (
        "cohesion = 1 MPa",
        "opening_at_knee = 0.008 mm",
        "share_at_knee = 0.3",
        "No room for the second line",
    ):
        assert words in text
    assert "12 N/m beyond the peak, 13.12 with the elastic part; given: 12" in text
    assert "at 1 MPa: 58 N/m beyond the peak" in text


def test_the_picture_is_drawn_where_it_is_asked_for_and_by_default_beside(package, capsys, tmp_path):
    assert said(capsys, "bilinear", "--plot").splitlines()[-1] == "law-bilinear.png"
    assert said(capsys, "linear", "--plot", "mine.png").splitlines()[-1] == "mine.png"
    pixels = imread(tmp_path / "law-bilinear.png")
    assert pixels.shape[:2] == (1040, 1360) and pixels[..., :3].std() > 0.05


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["bilinea"], "there is no law 'bilinea'; known here: bilinear, brittle"),
        (["bilinea"], "did you mean 'bilinear'"),
        (["linear", "--set", "cohesion"], "write KEY=VALUE"),
        (["linear", "--set", "cohesion=1 m"], "cohesion is a stress"),
        (["linear", "--plot", "x.gif"], "nearest: 'x.png'"),
        (["--plot"], "go with the NAME of a law"),
    ],
)
def test_wrong_words_get_one_message(package, capsys, words, message):
    assert main(["law", *words]) == 2
    output = capsys.readouterr()
    assert message in output.err and len(output.err.splitlines()) == 1


def test_an_area_that_is_not_the_integral_of_its_curve_is_told(tmp_path, capsys):
    files = files_of_page()
    files["bilinear.py"] = files["bilinear.py"].replace("parameters.G_I * area", "0.9 * parameters.G_I * area")
    with on_the_path(install(tmp_path / "wrong", files)):
        assert "its tension_area is not the integral of its tension_intact" in " ".join(
            said(capsys, "bilinear").split()
        )


@pytest.mark.parametrize("name", ["brittle", "linear", "polynomial", "exponential"])
def test_the_energies_of_our_laws_are_those_of_their_closed_forms(name):
    measured, joint = portrait(*law(name)), Joint()
    whole = float(closed_forms.dissipated_in_tension(name, joint, 1.0))
    assert measured.mode_1.whole == pytest.approx(whole, rel=3e-4)
    assert measured.mode_1.booked == pytest.approx(whole, rel=1e-9)
    for compression in COMPRESSIONS:
        end, residual = 1.0 + float(joint.peak(compression)) / joint.ks, float(joint.residual(compression))
        wanted = float(closed_forms.dissipated_in_shear(name, joint, end, compression))
        friction = residual * (end - residual / joint.ks)
        assert measured.mode_2[compression].whole == pytest.approx(wanted - friction, rel=3e-4)


def test_the_ways_of_a_portrait_go_back_and_forth():
    measured = portrait(*law("exponential"))
    assert np.sum(np.diff(np.sign(np.diff(measured.tension.opening))) != 0) == 2
    assert measured.tension.sigma.min() < 0.0 < measured.tension.sigma.max() == pytest.approx(0.58e6, rel=1e-2)
    for compression, path in measured.shear.items():
        np.testing.assert_allclose(path.sigma, -compression, rtol=1e-12)
        assert path.tau.min() < 0.0 and np.all(np.diff(path.fracture) >= -1e-9)


LAWS = ("brittle", "elastic", "exponential", "friction", "linear", "polynomial")
NOTHING = {
    "stress": "0 Pa",
    "stiffness": "0 Pa/m",
    "energy": "0 N/m",
    "energy per stress": "0 N/m/Pa",
    "angle": "0 deg",
    "length": "0 m",
    "number": "0",
}


def zeros() -> list[list[str]]:
    """Every quantity of a contact set to 0, and some of them together."""
    kinds = {key: law_report._kind(Contact, key) for key in Contact.model_fields}
    alone = [[f"{key}={NOTHING[kind]}"] for key, kind in kinds.items()]
    weak = ["tensile_strength=0 Pa", "cohesion=0 Pa"]
    ground = ["residual_friction_angle=0 deg", "friction_angle=0 deg"]
    options = ("unloading=elastic", "softening_variable=plastic", "coupling=independent")
    pairs = [[*some, option] for some in (weak, weak[:1], weak[1:]) for option in options]
    return [*alone, weak, [*weak, *ground], *pairs]


@pytest.mark.parametrize("name", LAWS)
def test_a_law_is_drawn_at_every_zero_that_a_scene_may_hold(name, monkeypatch):
    monkeypatch.setattr(law_portrait, "POINTS", 6)
    drawn = 0
    for changes in zeros():
        try:
            contact = law_report._contact(name, changes)
            measured = portrait(*build("unit_unit", contact.properties(), (0.0, *COMPRESSIONS)))
        except SceneError:
            continue
        drawn += 1
        assert "nan" not in str(law_report._energies(contact, measured)), changes
        for path in (measured.tension, *measured.shear.values()):
            assert np.isfinite(np.array(path)).all() and np.ptp(path.slip) + np.ptp(path.opening) > 0.0, changes
        torn_by_nothing = not contact.tensile_strength or (contact.tan_friction and not contact.cohesion)  # at the apex
        assert (measured.mode_1 is None) == (name in ("elastic", "friction") or bool(torn_by_nothing))
    assert drawn > 9
    law_figure(name, measured)


def test_a_contact_without_stiffness_in_shear_slides_without_stress():
    measured = portrait(*law("elastic", shear_stiffness=0.0))
    assert all(not path.tau.any() and not path.stored[-1] - path.stored[0] for path in measured.shear.values())


@pytest.mark.parametrize(("name", "changes"), [("elastic", "shear_stiffness=0 Pa/m"), ("brittle", "cohesion=0 Pa")])
def test_a_law_that_takes_0_does_not_say_that_it_refuses_it(name, changes, capsys):
    text = said(capsys, name, "--set", changes)
    assert "only what is out of the range of its key" in text and "above 0" not in text


@pytest.mark.parametrize("energy", [1e-8, 1e-6, 5.8, 1e9])
def test_an_energy_of_any_size_is_measured_beyond_the_peak(energy):
    measured = portrait(*law("exponential", fracture_energy_mode_1=energy, fracture_energy_mode_2=energy))
    assert measured.mode_1.beyond == pytest.approx(energy, rel=1e-4)
    assert measured.mode_2[0.0].beyond == pytest.approx(energy, rel=1e-4)


def test_what_is_left_beyond_the_peak_just_above_a_snap_back_is_measured():
    triangle = 0.5 * 0.58e6**2 / 150e9
    measured = portrait(*law("linear", fracture_energy_mode_1=1.1214))
    assert measured.mode_1.beyond == pytest.approx(1.1214 - triangle, rel=1e-3)


def test_a_brittle_law_has_no_energy_beyond_the_peak():
    measured = portrait(*law("brittle"))
    assert [measured.mode_1.beyond, *(energy.beyond for energy in measured.mode_2.values())] == [0.0] * 5


CAP = {"crushing": "cap", "closing_at_peak": 0.09e-3, "fracture_energy_compression": 5e3}
CUT_OFF = {"crushing": "cut-off", "fracture_energy_compression": 5e3}


@pytest.mark.parametrize("options", [CAP, CUT_OFF], ids=["cap", "cut-off"])
@pytest.mark.parametrize("name", ["friction", "exponential"])
def test_the_areas_in_compression_are_those_of_the_closed_forms(name, options):
    crushes = portrait(*law(name, compressive_strength=10.5e6, **options)).crushing
    areas = crushes.areas
    assert areas.softening == pytest.approx(5e3, rel=1e-4) == areas.softening_wanted
    assert areas.hardening == pytest.approx(
        (1 / 3 + np.pi / 6) * 10.5e6 * options.get("closing_at_peak", 0.0), rel=1e-4
    )
    assert crushes.curve.sigma.min() == pytest.approx(-10.5e6, rel=3e-3)
    (surface,) = [points for words, points in crushes.surface.items() if words in ("at the strength", "yields")]
    assert np.all(np.abs(surface[:, 0]) <= 10.5e6 * (1 + 1e-9)) and surface[-1, 0] == pytest.approx(-10.5e6)
    cap = np.hypot(np.minimum(surface[:, 0], 0.0), 3.0 * surface[:, 1] if "closing_at_peak" in options else 0.0)
    assert cap.max() == pytest.approx(10.5e6, rel=1e-9)


def test_a_law_that_crushes_says_so_and_has_a_third_column(capsys):
    words = ["--set=crushing=cap"]
    words += ["--set=compressive_strength=10.5 MPa", "--set=fracture_energy_compression=5 N/mm"]
    text = said(capsys, "friction", *words, "--set=closing_at_peak=0.09 mm")
    assert "compressive_strength = 10.5 MPa" in text and "given: 5000" in text and "closed form: 809.8" in text
    assert len(law_figure("cap", portrait(*law("exponential", compressive_strength=1e6, **CAP))).axes) == 7
    assert len(law_figure("plain", portrait(*law("exponential"))).axes) == 4
