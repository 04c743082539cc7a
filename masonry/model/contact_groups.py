"""Which contact group a contact belongs to, from the blocks on its two sides."""

import numpy as np

from geometry.blocks import Blocks, Joints


def contact_group_name(group_a: str, group_b: str, same_unit: bool) -> str:
    """within_units, within_mortar, unit_mortar, unit_unit, plate; else within_g, or g_h in alphabetical order."""
    pair = {group_a, group_b}
    if "plates" in pair:
        return "plate"
    if same_unit and group_a == group_b:
        return f"within_{group_a}"
    if pair == {"units"}:
        return "unit_unit"
    if pair == {"units", "mortar"}:
        return "unit_mortar"
    return "_".join(sorted((group_a, group_b)))


def contact_groups(blocks: Blocks, joints: Joints) -> tuple[tuple[str, ...], np.ndarray]:
    """Names of the groups that occur, and the (C,) index of each contact's group."""
    count = len(blocks.groups)
    a, b = joints.block_a, joints.block_b
    same = blocks.unit[a] == blocks.unit[b]
    code = (blocks.group[a] * count + blocks.group[b]) * 2 + same
    codes, index = np.unique(code, return_inverse=True)
    name_of_code = [
        contact_group_name(blocks.groups[c // 2 // count], blocks.groups[c // 2 % count], bool(c % 2)) for c in codes
    ]
    names = tuple(sorted(set(name_of_code)))
    return names, np.array([names.index(name) for name in name_of_code], dtype=np.int64)[index]
