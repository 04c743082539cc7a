"""Which contact table serves two blocks that meet, whatever their groups: for runs in which contacts are found anew."""

from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Any

import numpy as np

from geometry.blocks import Blocks
from masonry.errors import SceneError
from masonry.laws.building import factory
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.restitution import MOST_LENGTH, further_share
from masonry.model.contact_groups import contact_group_name
from masonry.model.damping import swing_of
from masonry.model.large.meeting import Meetings
from masonry.patches.arrays import Rules
from masonry.scene import Scene

NONE = -1
SKIN = 0.02
"""Of the mean size of a block, where the scene gives none."""
ALONG = 10
"""Points along the edges of patches that may crush: a toe bears its moment within 3 % (docs/theory/crushing.md)."""


@dataclass(frozen=True)
class Pairs:
    """Contact groups of all pairs of blocks that may meet.

    names       of the groups, in alphabetical order
    number      (G, G, 2) of the group for blocks of groups g and h (of Blocks.groups), of two units (0) or of one (1);
                symmetric; -1 where there are no two such blocks
    properties  by name, as Contact.properties gives them
    laws        by name, (parameters, properties) of its law, as laws.building.factory.build makes them
    """

    names: tuple[str, ...]
    number: np.ndarray
    properties: dict[str, ContactProperties]
    laws: dict[str, tuple[Any, Any]]


def pairs_of(scene: Scene, blocks: Blocks, compressions: list[float]) -> Pairs:
    """All pairs of groups, each with its table or [contact.default]. SceneError naming those that have neither."""
    name_of = _names(blocks)
    names = tuple(sorted(set(name_of.values())))
    missing = [name for name in names if name not in scene.contact and "default" not in scene.contact]
    if missing:
        raise SceneError(
            f'[contact.{missing[0]}] is missing: with displacements = "large" any two blocks may meet. Give '
            f"{', '.join(f'[contact.{name}]' for name in missing)}, or [contact.default] for all that have none"
        )
    number = np.full((len(blocks.groups), len(blocks.groups), 2), NONE, dtype=np.int64)
    for (g, h, same), name in name_of.items():
        number[g, h, same] = number[h, g, same] = names.index(name)
    properties = {name: scene.contact_of(name).properties(scene.turns_back) for name in names}
    return Pairs(
        names, number, properties, {name: factory.build(name, properties[name], compressions) for name in names}
    )


def meetings_of(pairs: Pairs, scene: Scene) -> Meetings:
    """Behaviour of blocks that meet without a bond: stiffnesses, dashpot, and the friction and cohesion that stay."""
    numbers = []
    for name in pairs.names:
        joint = pairs.laws[name][1]
        friction = joint.tan_friction if joint.tan_residual_friction is None else joint.tan_residual_friction
        dashpot = pairs.properties[name].normal_dashpot or 0.0
        cohesion = joint.residual_cohesion or 0.0
        shear = joint.shear_stiffness or joint.normal_stiffness  # 0 of a roller, of which friction 0 makes one as well
        numbers.append((joint.normal_stiffness, shear, friction or 0.0, dashpot, cohesion))
    kn, ks, tan, damping, left = np.array(numbers, dtype=float).reshape(-1, 5).T.copy()
    bounces = [pairs.properties[name].restitution for name in pairs.names]
    rise = np.array([(*further_share(e), MOST_LENGTH) if e else (0.0, 0.0, 0.0) for e in bounces])
    rules = Rules(kn, ks, tan, damping, left if left.any() else None, rise=rise if rise.any() else None)
    cap, cut_off = _crushing(pairs)
    rules = rules._replace(cap=cap, cut_off=cut_off)
    skin, branches = scene.solver.skin, swing_of(scene.damping).branch_count
    spread = scene.specimen.patch_points == "spread"
    along = points_along(scene, cap is not None or cut_off is not None)
    return Meetings(rules, pairs.number, SKIN if skin is None else skin, spread, branches, along)


def points_along(scene: Scene, crushes: bool) -> int:
    """How many points a patch has along its edges, if a scene does not spread them."""
    if scene.specimen.patch_points_per_edge is not None:
        return scene.specimen.patch_points_per_edge
    chosen = scene.specimen.patch_points is not None or any(map(scene.is_meshed, scene.material))
    return ALONG if crushes and not chosen else 2


def _crushing(pairs: Pairs) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Rules.cap and Rules.cut_off."""
    cap, cut_off = np.zeros((len(pairs.names), 4)), np.zeros((len(pairs.names), 2))
    for row, name in enumerate(pairs.names):
        joint = pairs.laws[name][1]
        if joint.compressive_strength is None:
            continue
        energy = np.inf if joint.crushing_energy is None else joint.crushing_energy
        if joint.cap_shear_factor is None:
            cut_off[row] = joint.compressive_strength, energy
        else:
            cap[row] = joint.compressive_strength, energy, joint.closing_at_peak, joint.cap_shear_factor
    return (cap if cap.any() else None, cut_off if cut_off.any() else None)


def _names(blocks: Blocks) -> dict[tuple[int, int, int], str]:
    """The contact group of two blocks of groups g <= h, of two units (0) or of one (1), for all that there are."""
    names = {}
    units = [np.unique(blocks.unit[blocks.group == g], return_counts=True) for g in range(len(blocks.groups))]
    for g, h in combinations_with_replacement(range(len(units)), 2):
        (own, count), (others, _) = units[g], units[h]
        shared = np.intersect1d(own, others)
        there = {
            0: bool(len(own) and len(others)) and len(np.union1d(own, others)) > 1,
            1: bool((count > 1).any()) if g == h else len(shared) > 0,
        }
        for same in (0, 1):
            if there[same]:
                names[g, h, same] = contact_group_name(blocks.groups[g], blocks.groups[h], bool(same))
    return names
