"""From a scene's words to a specimen: blocks with named sets."""

from dataclasses import replace

import numpy as np

from geometry.blocks import Specimen
from geometry.specimens.numbered import numbered_by_place
from geometry.specimens.placed import on_floor, turned, with_slabs
from masonry.errors import SceneError
from masonry.jit.sources import source_hash
from masonry.scene import Scene


def specimen_of(scene: Scene) -> Specimen:
    """The blocks of a scene, with named sets; raises GeometryError for what cannot be built."""
    section = scene.specimen.section
    if scene.specimen.bridges_gaps:
        _require_what_goes_with_gaps(scene)
    specimen = _specimen_of(scene)
    specimen = specimen if section is None else replace(specimen, section=section)
    specimen = with_slabs(specimen, [(slab.name, slab.origin, slab.size, slab.group) for slab in scene.specimen.slab])
    specimen = numbered_by_place(specimen) if scene.is_large and scene.specimen.placed_by_hand else specimen
    if scene.specimen.turned is not None:
        stated = specimen.joints and replace(specimen.joints, points=as_turned(scene, specimen.joints.points))
        blocks = replace(specimen.blocks, points=as_turned(scene, specimen.blocks.points))
        specimen = replace(specimen, blocks=blocks, joints=stated)
    if (floor := scene.floor) is None:
        return specimen
    return on_floor(specimen, floor.level, floor.size, floor.thickness, _travel_of_ground(scene))


def _travel_of_ground(scene: Scene) -> float:
    """m, at most, by which something that does not follow the ground comes to lie beside where it stood on it."""
    if not scene.ground:
        return 0.0
    lasts = scene.solver.duration or max(ground.runs_for for ground in scene.ground)
    motions = [
        (motion, ground.begin) for ground in scene.ground for axis, motion in ground.motions.items() if axis != "z"
    ]
    ends = [abs(float(motion.displacement_at(np.array([lasts - begin]))[0])) for motion, begin in motions]
    return max([*ends, *(motion.peak_displacement for motion, _ in motions)], default=0.0)


def as_turned(scene: Scene, points: np.ndarray) -> np.ndarray:
    """Points (n, 3) m of the specimen as it was built, where it stands in the scene."""
    rotation = scene.specimen.turned
    if rotation is None:
        return points
    return turned(points, np.eye(3)["xyz".index(rotation.about)], rotation.angle, rotation.through)


def _specimen_of(scene: Scene) -> Specimen:
    """With the section that is the specimen's own."""
    spec = scene.specimen
    forms = {cells.form for cells in spec.all_cells}
    if not forms:
        return spec.build()
    from masonry.jit.compiler import REST, once

    with once(f"{'-'.join(sorted(forms))}-{source_hash(('geometry/cells',))}", REST):
        return spec.build()


def _require_what_goes_with_gaps(scene: Scene) -> None:
    """Raise SceneError for what needs blocks that meet, where the joints of a file bridge gaps."""
    why = "the blocks of this file only nearly meet, and its joints bridge the gaps"
    if scene.is_large:
        raise SceneError(
            f'displacements = "large": {why}; large displacement finds contacts where blocks touch: import it without '
            "--gap, by a --tolerance that closes the gaps, or leave displacements small"
        )
    if any(scene.is_meshed(g) for g in scene.material):
        raise SceneError(f"kinematics 'tets': {why}, where no mesh has nodes; take 'rigid' or 'affine'")
    if scene.specimen.is_divided:
        raise SceneError(f"specimen.divisions and cells: {why}, which parts of blocks do not share; leave them out")
    if scene.floor is not None:
        raise SceneError(f"[floor]: {why}; hold the lowest blocks by a [[support]] instead")
