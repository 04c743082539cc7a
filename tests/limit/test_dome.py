"""Domes and vaults: a hemisphere stands from a thickness of 0.042 radii on (Heyman 1967); orange slices; an arch."""

import numpy as np
import pytest

import masonry
from geometry.blocks import Blocks, Specimen
from geometry.polyhedra.measures import centroids, volumes
from geometry.structures.dome import dome
from masonry.statics.solve import STANDS, largest_factor, standing
from tests.limit.blocks import CONES, dry
from tests.structures.lines_of_thrust import greatest_crown_load


def thin(thickness: float, courses: int, sectors: int) -> tuple[Blocks, np.ndarray]:
    """Courses of voussoirs of mean radius 1 m without bond, a small opening at the top; and the blocks it stands on."""
    built = dome(1.0, thickness, courses, sectors, float(np.sin(0.1)), bond="stack", closed=False)
    return built.blocks, built.sets["base"]


@pytest.mark.parametrize(("thickness", "stands"), [(0.0412, False), (0.0425, True)])
def test_a_hemisphere_of_480_voussoirs_stands_from_its_least_thickness_on(thickness, stands):
    solution = standing(*dry(*thin(thickness, 20, 24), 0.7), CONES)
    assert (solution.factor >= STANDS) == stands


def test_a_dome_falls_alike_whichever_way_it_is_pushed():
    blocks, held = thin(0.06, 8, 12)
    pushed = [
        largest_factor(*dry(blocks, held, 0.7, live=(np.cos(a), np.sin(a), 0.0))) for a in (0.0, np.pi / 6, np.pi)
    ]
    assert [solution.factor for solution in pushed] == pytest.approx([pushed[0].factor] * 3, rel=1e-6)
    assert max(solution.gap for solution in pushed) < 1e-6


def load_on_slices(built: Specimen, courses: int, sectors: int, radius: float, thickness: float, crown: float) -> float:
    """Greatest load (N) on the crown that a dome bears as orange slices, without hoops."""
    weight, middle = 2000 * 9.81 * volumes(built.blocks), centroids(built.blocks)
    first = sectors * np.arange(courses)
    cap = weight[built.sets["keystone"][0]] / sectors
    steep = np.linspace(0.5 * np.pi, np.arcsin(crown / radius), courses + 1)
    way = np.stack([np.sin(steep) * np.cos(np.pi / sectors), np.cos(steep)], axis=1)
    inner, outer = ((radius + side * thickness) * way for side in (-0.5, 0.5))
    return sectors * greatest_crown_load(weight[first], np.hypot(*middle[first, :2].T), cap, inner, outer)


@pytest.mark.parametrize("thickness", [0.15, 0.3])
def test_a_load_on_the_crown_of_a_dome_without_bond_is_borne_by_orange_slices(thickness):
    courses, sectors = 8, 12
    sizes = {"bond": "stack", "courses": courses, "voussoirs": sectors, "thickness": f"{thickness} m"}
    down = {"pattern": "force", "on": "keystone", "force": {"z": "-1 N"}}
    limit = masonry.limit(
        masonry.load("dome-own-weight", {**{f"specimen.{key}": value for key, value in sizes.items()}, "limit": down})
    )
    by_hand = load_on_slices(limit.specimen, courses, sectors, 3.0, thickness, 0.4)
    assert limit.factor == pytest.approx(by_hand, rel=1e-6)


def test_a_vault_in_bond_has_the_least_and_the_greatest_thrust_of_an_arch():
    vault, arch = masonry.limit("vault-spreading"), masonry.limit("arch-spread")
    assert [vault.factor, vault.least] == pytest.approx([6 * arch.factor, 6 * arch.least], rel=1e-6)


@pytest.mark.slow
def test_a_vault_whose_abutment_gives_way_is_left_with_its_least_thrust():
    force = masonry.run("vault-spreading").history.rows["force"][-1]
    assert force == pytest.approx(masonry.limit("vault-spreading").least, rel=1e-6)


@pytest.mark.slow
def test_a_dome_of_480_voussoirs_comes_to_rest_on_its_base():
    result = masonry.run("dome-own-weight")
    blocks = result.specimen.blocks
    weight = 2000 * 9.81 * volumes(blocks).sum()
    assert result.summary["reactions"]["end"]["support.0"]["force_n"][2] == pytest.approx(weight, rel=1e-9)
    assert result.summary["unbalanced_after_settling"] < 1e-9
