"""The step of large displacement: as Fig. 2 of the paper, with bonds in frames that turn and patches that are detected.

A scene of small displacement compiles nothing of this file.
"""

from masonry.jit.compiler import jit
from masonry.kernels.bonds import from_frames, part_rigid, push_rigid, to_frames
from masonry.kernels.gathering import gather_places, gather_velocities, hand_over
from masonry.kernels.step import pull, reaction, sweep_groups
from masonry.kinematics.dispatch import move, update_positions
from masonry.patches.press import press
from masonry.patches.press_deforming import press_deforming
from masonry.patches.refreshing import count_travel, refresh


@jit
def advance(
    first, steps, dt, damping, dead_load, speed, groups, contacts, bonds, bodies, drives, near, members, drive_force
):
    """Run up to `steps` steps from step number `first`; returns how many were run: fewer where room ran out.

    Arguments as of kernels.step.advance; contacts hold displacements and forces in the frames of the bonds.
    bonds  Bonds
    near   Near, what blocks meet
    members  gathering.Members, where some blocks deform, else None
    """
    parameters, properties, states, ranges = groups
    sides, normal, area, local, force = contacts
    rigid, affine, tets = bodies
    rigid_drive, affine_drive, tet_drive = drives
    if members is not None:
        gather_places(near.motion, members, rigid, affine, tets, bonds)
    spare = 0.0  # m, how far two blocks may travel until pairs are to be looked at
    for k in range(steps):
        n = first + k
        if members is not None:
            gather_velocities(near.motion, members, rigid, affine, tets)
        step = 2.0 * count_travel(near.motion, dt, near.motion.strain)
        spare -= step
        if spare <= 0.0:
            spare = refresh(near, step)
        if spare < 0.0:
            return k
        update_positions(None, rigid, dt, bonds.u)
        update_positions(None, affine, dt, bonds.u)
        update_positions(None, tets, dt, bonds.u)
        if members is not None:
            gather_places(near.motion, members, rigid, affine, tets, bonds)
        if members is None:
            part_rigid(bonds, near.motion, local)
        else:
            to_frames(bonds, local)
        sweep_groups(None, parameters, properties, states, 0, ranges, sides, normal, area, local, force)
        if members is None:
            press(near, dt)
            push_rigid(bonds, near.motion, local, force)
        else:
            from_frames(bonds, force)
            press_deforming(near, dt)
            hand_over(near.motion, members, rigid, affine, tets)
        loading = dead_load[n + 1], dead_load[n], speed[n + 1], speed[n]
        move(None, rigid, dt, damping, loading, bonds.force, bonds.u)
        move(None, affine, dt, damping, loading, bonds.force, bonds.u)
        move(None, tets, dt, damping, loading, bonds.force, bonds.u)
        drive_force[k] = reaction(rigid, rigid_drive) + reaction(affine, affine_drive) + reaction(tets, tet_drive)
        pull(rigid, rigid_drive, speed[n + 1])
        pull(affine, affine_drive, speed[n + 1])
        pull(tets, tet_drive, speed[n + 1])
    return steps
