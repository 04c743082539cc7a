"""Lines of `masonry check` on bars and slabs: one for each table of them."""

from math import dist

import numpy as np

from geometry.polyhedra.measures import volumes
from masonry.assembly.assemble import Assembly, material_of
from masonry.judgement.words import readable
from masonry.scene.tables.specimens.bar import BarTable

FEW = 4
"""Blocks whose numbers are told."""


def bar_lines(assembly: Assembly) -> list[str]:
    """How many bars, how long, their stiffness and yield force, and between what."""
    links = [one.plan.links() for one in assembly.model.elements if one.name == "bars"]
    bars, lines = assembly.scene.bar, []
    first = 0
    for k, bar in enumerate(bars):
        ends = links[0][first : first + bar.repeat].T
        between = " and ".join(_blocks(blocks) for blocks in ends.tolist())
        many = "" if bar.repeat == 1 else f"{bar.repeat} "
        name = f"'{bar.name}'" if bar.name else f"bar {k}" if bar.repeat == 1 else f"bars of table {k}"
        length = readable(f"{dist(*bar.ends)} m", 4)
        lines.append(f"{many}{name}, {length} long, {_strength(bar)}; between {between}")
        first += bar.repeat
    return lines


def _strength(bar: BarTable) -> str:
    force = bar.yield_force
    words = [readable(f"{bar.stiffness} N/m", 4), "never yields" if force is None else f"yields at {force:.4g} N"]
    words += ["pulls and pushes" if bar.compression else "pulls"]
    words += [f"tightened to {bar.pretension:.4g} N"] if bar.pretension else []
    return ", ".join(words + ([f"slack by {readable(f'{bar.slack} m', 4)}"] if bar.slack else []))


def slab_lines(assembly: Assembly) -> list[str]:
    """How large and heavy each slab is, and on what area it has joints with how many blocks."""
    specimen, joints, lines = assembly.specimen, assembly.joints, []
    volume = volumes(specimen.blocks)
    for slab in assembly.scene.specimen.slab:
        block = int(specimen.sets[slab.name][0])
        mass = volume[block] * material_of(assembly.scene, slab.group).density
        mine = (joints.block_a == block) | (joints.block_b == block)
        others = np.unique(np.concatenate([joints.block_a[mine], joints.block_b[mine]]))
        size = " x ".join(f"{length:.4g}" for length in slab.size)
        rests = (
            f"joints of {joints.area[mine].sum():.4g} m2 with {_count(len(others) - 1)}" if mine.any() else "no joint"
        )
        lines.append(f"'{slab.name}', {size} m, {mass:.4g} kg, {rests}")
    return lines


def _count(blocks: int) -> str:
    return f"{blocks} block{'s'[: blocks != 1]}"


def _blocks(numbers: list[int]) -> str:
    """The blocks that hold one end of some bars; -1 is an end that stays in space."""
    blocks = sorted(set(numbers))
    if blocks == [-1]:
        return "a fixed end" if len(numbers) == 1 else "fixed ends"
    if len(blocks) == 1:
        return f"block {blocks[0]}"
    return f"blocks {', '.join(map(str, blocks))}" if len(blocks) <= FEW else _count(len(blocks))
