"""Blocks with dry joints and loads, as bodies and contacts of a limit analysis."""

from dataclasses import replace

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import moments
from geometry.specimens.boxes import boxes
from masonry.statics.problem import RigidBodies, RigidContacts
from masonry.statics.solve import Method

PLANE, CONES, PYRAMIDS = Method(), Method(plane=False), Method(plane=False, sides=16)
DOWN = (0.0, 0.0, -1.0)


def dry(
    blocks: Blocks, held, friction: float, live=(1.0, 0.0, 0.0), dead=DOWN, density=1.0, points: int = 2
) -> tuple[RigidBodies, RigidContacts]:
    """Blocks of unit weight per volume on held ones; loads in shares of the weight."""
    joints = find_joints(blocks, "vertex", points)
    volume, centre, _ = moments(blocks)
    weight = density * volume
    loads = [np.zeros((blocks.count, 6)) for _ in range(2)]
    for load, way in zip(loads, (dead, live), strict=True):
        load[:, :3] = weight[:, None] * np.array(way)
    free = np.ones((blocks.count, 6), dtype=bool)
    free[held] = False
    number = len(joints.area)
    none = np.zeros(number)
    contacts = RigidContacts(
        *(joints.block_a, joints.block_b, joints.point, joints.normal, joints.patch, joints.area),
        *(np.full(number, friction), none, none, np.zeros(number, dtype=bool)),
    )
    return RigidBodies(centre, free, *loads), contacts


def stack(sizes, overhangs=None, depth: float = 0.3) -> Blocks:
    """A fixed ground, block 0, and boxes (length, height) on each other, each shifted along x by an overhang."""
    found, level = [("ground", (-5.0, 0.0, -1.0), (10.0, depth, 1.0), "units", 0, (1, 1, 1))], 0.0
    for k, (length, height) in enumerate(sizes):
        shift = 0.0 if overhangs is None else overhangs[k]
        found.append((f"block {k}", (shift, 0.0, level), (length, depth, height), "units", k + 1, (1, 1, 1)))
        level += height
    return boxes(found, 1.0).blocks


def wall(courses: int, halves_below: bool, length: float = 0.4, height: float = 0.175, units: int = 5) -> Blocks:
    """A fixed ground, block 0, and a wall in running bond, `units` long; halves at the ends of every other course."""
    found, number = [("ground", (-1.0, 0.0, -0.1), (units * length + 2.0, 0.1, 0.1), "units", 0, (1, 1, 1))], 1
    for course in range(courses):
        halves = (course % 2 == 0) == halves_below
        inner = length * (np.arange(units) + 0.5) if halves else length * np.arange(1, units)
        edges = [0.0, *inner.tolist(), units * length]
        for low, high in zip(edges[:-1], edges[1:], strict=True):
            size = (high - low, 0.1, height)
            found.append((f"unit {number}", (low, 0.0, course * height), size, "units", number, (1, 1, 1)))
            number += 1
    return boxes(found, 1.0).blocks


def turned(bodies: RigidBodies, contacts: RigidContacts, turn: np.ndarray) -> tuple[RigidBodies, RigidContacts]:
    """All of it turned by a rotation (3, 3); bodies must be held wholly or not at all."""

    def both(load: np.ndarray) -> np.ndarray:
        return np.concatenate([load[:, :3] @ turn.T, load[:, 3:] @ turn.T], axis=1)

    bodies = replace(bodies, centre=bodies.centre @ turn.T, dead=both(bodies.dead), live=both(bodies.live))
    return bodies, replace(contacts, point=contacts.point @ turn.T, normal=contacts.normal @ turn.T)
