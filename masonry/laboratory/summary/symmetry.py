"""Whether cracks that began symmetrically went on so: where two are alike, the pace decides which one opens."""

from collections.abc import Callable, Iterator

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.polyhedra.measures import centroids
from masonry.assembly.assemble import Assembly, material_of
from masonry.assembly.conditions import conditions_of
from masonry.assembly.growing_loads import let_grow
from masonry.assembly.masses import density_of
from masonry.model.layout import lay_out
from masonry.model.loads import Conditions
from masonry.rows.history import Frame

SAME = 1e-6
"""Of the size of the specimen: how far a contact may lie from the mirror image of another one."""
CRACKED = 1e-3
"""Share of the area of all contacts, weighed by damage, from which on cracks count."""
KEPT, LOST = 0.02, 0.1
"""Share of the cracks without a mirror image, up to which they are symmetric, and from which on they are not. The
wallette of failure mode 1 comes from 0.000 to 0.6; with strengths that scatter by 1 % from 0.001 to 0.004, by 3 % from
0.01 to 0.02, and by 10 % from 0.04 to 0.09: then the pace decides nothing any more."""


def symmetry_lost(
    joints: Joints, frames: list[Frame], is_loaded_alike: Callable[[str], bool] = lambda axis: True
) -> str:
    """The axis ("x", "y" or "z") across whose middle plane the cracks were symmetric and are so no more; "" without.

    is_loaded_alike  of an axis: whether supports and loads are symmetric across it; else cracks have to be as they are
    """
    area = joints.area
    cracks = [frame.damage for frame in frames if area @ frame.damage > CRACKED * area.sum()]
    if len(cracks) < 2:
        return ""
    for axis, image in _images(_inside(joints)):
        alone = [float(area @ np.abs(damage - damage[image]) / (2.0 * area @ damage)) for damage in cracks]
        if min(alone) <= KEPT and alone[-1] >= LOST and is_loaded_alike(axis):
            return axis
    return ""


def is_loaded_alike(assembly: Assembly, axis: str) -> bool:
    """Whether what holds, drives and loads the blocks is its own mirror image across the middle plane of an axis.

    What a drive draws away along the axis from what a support holds there is alike: both ends move apart. How a
    block is held does not count, only whether it is.
    """
    k, blocks = "xyz".index(axis), assembly.specimen.blocks
    if (image := _image_of_blocks(blocks, k)) is None:
        return False
    conditions = _as_rigid(assembly)
    sign = np.where(np.arange(3) == k, -1.0, 1.0)
    for load in conditions.each_load.values():
        loaded = load["rigid"]
        force = np.zeros((blocks.count, 6)) if loaded is None else loaded
        if np.abs(force[image] * np.concatenate([sign, -sign]) - force).max() > SAME * np.abs(force).max():
            return False
    holds = np.asarray(conditions.prescribed["rigid"].any(axis=1))
    if not np.array_equal(holds[image], holds):
        return False
    drive = assembly.scene.drive
    if drive is None:
        return True
    masks = conditions.held_by["drive"]["rigid"], conditions.supported["rigid"]
    driven, supported = (mask[:, drive.axis] for mask in masks)
    return bool(np.array_equal(driven[image], supported if drive.axis == k else driven))


def _as_rigid(assembly: Assembly) -> Conditions:
    """Supports and loads of the blocks, each of these taken as rigid."""
    scene = assembly.scene.model_copy(update={"motion": (), "kinematics": {"default": "rigid"}})
    specimen, joints = assembly.specimen, assembly.joints
    layout = lay_out(specimen.blocks, dict.fromkeys(specimen.blocks.groups, "rigid"), None)
    materials = {group: material_of(scene, group) for group in specimen.blocks.groups}
    density = density_of(scene, specimen, joints, materials)
    conditions = conditions_of(scene, specimen, layout, joints, density)
    if scene.grows:
        let_grow(scene, specimen, joints, layout, density, conditions)
    return conditions


def _image_of_blocks(blocks: Blocks, k: int) -> np.ndarray | None:
    """(B,) the number of each block's mirror image across the middle plane of axis k, by their centroids."""
    ends = blocks.points.min(axis=0), blocks.points.max(axis=0)
    return next((image for axis, image in _images(centroids(blocks), ends) if axis == "xyz"[k]), None)


def _inside(joints: Joints) -> np.ndarray:
    """(C, 3) m, places half-way from the contacts to the middles of their joints: no two joints share one."""
    corners = np.diff(joints.patch_start)
    middle = np.add.reduceat(joints.patch_points, joints.patch_start[:-1], axis=0) / corners[:, None]
    return np.asarray(0.5 * (joints.point + middle[joints.patch]))


def _images(place: np.ndarray, ends: tuple[np.ndarray, np.ndarray] | None = None) -> Iterator[tuple[str, np.ndarray]]:
    """Axes across which places (C, 3) m are symmetric, with the number of each one's mirror image (C,).

    ends  (3,) and (3,) m, between which the middle lies; without them those of the places
    """
    low, high = ends or (place.min(axis=0), place.max(axis=0))
    for k, axis in enumerate("xyz"):
        mirrored = place.copy()
        mirrored[:, k] = low[k] + high[k] - place[:, k]
        steps = _steps(np.concatenate([place, mirrored]), SAME * float((high - low).max()))
        here, there = steps[: len(place)], steps[len(place) :]
        one, other = np.lexsort(here.T), np.lexsort(there.T)
        if np.array_equal(here[one], there[other]):
            image = np.empty(len(place), dtype=np.int64)
            image[one] = other
            yield axis, image


def _steps(place: np.ndarray, width: float) -> np.ndarray:
    """Which of all different x, y, z each place (C, 3) has, counted from below; those nearer than a width are one."""
    order = np.argsort(place, axis=0)
    rises = np.diff(np.take_along_axis(place, order, axis=0), axis=0, prepend=place.min(axis=0)[None]) > width
    ranks = np.empty(place.shape, dtype=np.int64)
    np.put_along_axis(ranks, order, np.cumsum(rises, axis=0), axis=0)
    return ranks
