"""Earth on an arch: its weight, where it presses, and what it does to the load that the arch bears."""

from math import pi

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.scene import load as load_scene

G, EARTH = 9.81, 1800.0


def table(level: str, on: str = "voussoirs") -> dict:
    return {"fill": [{"on": on, "level": level, "density": "1800 kg/m^3"}]}


def held(result, what: str, axis: int) -> float:
    """Force or moment of both supports together."""
    return sum(result.summary["reactions"]["end"][f"support.{k}"][what][axis] for k in range(2))


def outline(facets: int):
    """x and z of the corners of the extrados."""
    step = 140.0 * pi / 180.0 / 15 / facets
    ends = np.arange(15 * facets + 1) * step - 70.0 * pi / 180.0
    return 2.1 * np.sin(ends), 2.1 * np.cos(ends)


@pytest.mark.parametrize(("level", "facets"), [("2.5 m", 1), ("2.5 m", 8), ("1.6 m", 1)])
def test_the_supports_bear_the_area_between_extrados_and_level(level, facets):
    changes = {"specimen.facets": facets, "settle.steps": 4000}
    bare, filled = (masonry.run(load_scene("arch-own-weight", changes | more)) for more in ({}, table(level)))
    x, z = outline(facets)
    fine = np.linspace(x[0], x[-1], 2_000_001)
    area = np.trapezoid(np.maximum(float(level.split()[0]) - np.interp(fine, x, z), 0.0), fine)
    assert held(filled, "force_n", 2) - held(bare, "force_n", 2) == pytest.approx(EARTH * G * 0.5 * area, rel=1e-6)
    assert filled.summary["force_balance"] < 1e-9 and filled.summary["energy_imbalance"] < 1e-12
    assert "fill.0" in filled.summary["work_of_loads_j"]


@pytest.mark.parametrize("kinematics", ["rigid", "affine"])
def test_earth_on_one_voussoir_presses_where_its_columns_stand(kinematics):
    stiff = {"material.units.young_modulus": "20 GPa", "material.units.poisson_ratio": 0.2}
    changes = {"kinematics": kinematics, "settle.steps": 8000} | (stiff if kinematics == "affine" else {})
    more = ({}, table("2.5 m", "voussoir 2"))
    bare, filled = (masonry.run(load_scene("arch-own-weight", changes | one)) for one in more)
    x, z = outline(1)
    fine = np.linspace(x[1], x[2], 200_001)
    press = EARTH * G * 0.5 * (2.5 - np.interp(fine, x, z))
    moment = np.trapezoid(press * fine, fine)
    assert held(filled, "moment_nm", 1) - held(bare, "moment_nm", 1) == pytest.approx(-moment, rel=1e-6)


def test_earth_on_the_haunches_helps_an_arch_to_bear_a_load_at_its_crown():
    bare, filled = (masonry.limit(load_scene("arch-own-weight", more)).factor for more in ({}, table("2.1 m")))
    assert filled > 1.2 * bare
    assert masonry.limit(load_scene("arch-own-weight", table("2.1 m") | {"fill.0.density": "1e-3 kg/m^3"})).factor == (
        pytest.approx(bare, rel=1e-5)
    )


def test_earth_moves_with_the_voussoirs_below_it_where_masses_are_real():
    ground = {"ground": {"x": "0.1 g * sin(2 pi t / 0.1 s)", "duration": "0.1 s"}, "settle.steps": 100}
    bare, filled = (assemble(load_scene("arch-own-weight", ground | more)) for more in ({}, table("2.5 m")))
    x, z = outline(1)
    earth = EARTH * 0.5 * np.trapezoid(2.5 - z, x)
    inertia = [assembly.model.varying[0]["rigid"][:, 0] for assembly in (bare, filled)]
    assert -(inertia[1] - inertia[0]).sum() == pytest.approx(earth, rel=1e-9)
    free = filled.model.masses["rigid"][:, 0] > 0.0
    assert filled.model.masses["rigid"][free, 0] == pytest.approx(-inertia[1][free], rel=1e-12)
    slow, quick = (masonry.modes(load_scene("arch-own-weight", more), 1) for more in (table("2.5 m"), {}))
    assert slow.mass[0] - quick.mass[0] == pytest.approx(earth, rel=1e-9)
    assert slow.frequencies[0] < quick.frequencies[0]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"fill.0.level": "0.1 m"}, "no free face of 'voussoirs' looks up below 0.1 m"),
        ({"fill.0.on": "arch"}, "selects nothing"),
        ({"gravity.x": "1 m/s^2"}, "presses by its weight along -z"),
        ({"limit": {"pattern": "weight", "direction": "x"}}, "would leave out the mass of the fill"),
        ({"kinematics": "tets", "specimen.mesh_size": "100 mm"}, "not on tets"),
    ],
)
def test_what_a_fill_cannot_be_is_said(changes, said):
    stiff = {"material.units.young_modulus": "20 GPa", "material.units.poisson_ratio": 0.2}
    with pytest.raises(SceneError, match=said):
        assemble(load_scene("arch-own-weight", table("2.5 m") | stiff | changes))
