"""Masses of blocks, and masses that move with them: their material, added masses, and earth on them."""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.polyhedra.intersect import holds
from geometry.polyhedra.measures import volumes
from masonry.assembly.conditions import select
from masonry.assembly.road.fill import columns_of
from masonry.errors import SceneError
from masonry.model.layout import Material
from masonry.scene import Scene

EDGE = 1e-6
"""Share of the size of the specimen by which a place may lie outside of a block that holds it."""


class Share(NamedTuple):
    """Of one added mass (kg): the blocks (n,) that bear it."""

    name: str
    mass: float
    blocks: np.ndarray


def density_of(scene: Scene, specimen: Specimen, joints: Joints, materials: dict[str, Material]) -> np.ndarray:
    """(B,) kg/m3, with what is added: a mass that blocks share makes each as much denser, so that its centre and its
    turning inertia are those of their volumes. Raises SceneError."""
    blocks = specimen.blocks
    density = np.array([materials[group].density for group in blocks.groups])[blocks.group]
    if scene.mass:
        volume = volumes(blocks)
        for share in shares_of(scene, specimen, joints):
            density[share.blocks] += share.mass / volume[share.blocks].sum()
    return density


def moving_density_of(scene: Scene, specimen: Specimen, joints: Joints, density: np.ndarray) -> np.ndarray:
    """(B,) kg/m3 of what moves with each block, of a density (B,) itself: the earth of a fill above it makes it as much
    denser. Raises SceneError."""
    if not scene.fill:
        return density
    earth = np.zeros(specimen.blocks.count)
    for k, fill in enumerate(scene.fill):
        columns = columns_of(fill, f"fill.{k}", specimen, joints, select(specimen, joints, fill.on, f"fill.{k}.on")[0])
        np.add.at(earth, columns.owner, fill.density * columns.volume)
    return np.asarray(density + earth / volumes(specimen.blocks))


def shares_of(scene: Scene, specimen: Specimen, joints: Joints) -> list[Share]:
    """The masses that a scene adds, and the blocks that bear them. Raises SceneError."""
    shares = []
    for k, added in enumerate(scene.mass):
        where = f"mass.{k}.on = '{added.on}'"
        chosen, faces = select(specimen, joints, added.on, f"mass.{k}.on")
        if faces is not None:
            raise SceneError(f"{where}: whole blocks bear a mass; name a set without a face, or 'blocks at z = ...'")
        groups = specimen.blocks.groups
        if any(scene.is_floor(groups[group]) for group in np.unique(specimen.blocks.group[chosen])):
            raise SceneError(f"{where}: the floor does not move, and weighs nothing; name blocks of the specimen")
        if added.at is not None:
            chosen = _holding(specimen, chosen, np.array(added.at), k, added.on)
        shares.append(Share(added.on, added.mass, chosen))
    return shares


def _holding(specimen: Specimen, chosen: np.ndarray, place: np.ndarray, k: int, on: str) -> np.ndarray:
    """The block, among some, that holds a place (3,) m."""
    width = EDGE * float(np.ptp(specimen.blocks.points, axis=0).max())
    for block in chosen.tolist():
        if holds(specimen.blocks, block, place, width):
            return np.array([block])
    words = ", ".join(f"{x:.6g}" for x in place)
    raise SceneError(f"mass.{k}.at = ({words}) m lies in no block of '{on}'; give a place in one, or leave it out")


def added_mass_lines(scene: Scene, specimen: Specimen, joints: Joints, materials: dict[str, Material]) -> list[str]:
    """A line for each mass that is added: on how many blocks, and how much that is beside their own."""
    if not scene.mass:
        return []
    blocks = specimen.blocks
    own = np.array([materials[group].density for group in blocks.groups])[blocks.group] * volumes(blocks)
    lines = []
    for share in shares_of(scene, specimen, joints):
        many = f"{len(share.blocks)} blocks" if len(share.blocks) > 1 else f"block {share.blocks[0]}"
        times = share.mass / own[share.blocks].sum()
        lines.append(f"{share.mass:.6g} kg on {many} of '{share.name}', {times:.3g} times their own")
    return lines
