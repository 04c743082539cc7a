"""The step of large displacement: as Fig. 2 of the paper, with bonds in frames that turn and patches that are detected.

A scene of small displacement compiles nothing of this file.
"""

from masonry.detection.bare import bare
from masonry.kernels.bonds import from_frames, to_frames
from masonry.kernels.patches import press
from masonry.kernels.refreshing import refresh
from masonry.kernels.step import pull, reaction, sweep_groups
from masonry.kinematics.dispatch import move, place


@bare
def advance(first, steps, dt, damping, dead_load, speed, groups, contacts, bonds, bodies, drives, near, drive_force):
    """Run up to `steps` steps from step number `first`; returns how many were run: fewer where room ran out.

    Arguments as of kernels.step.advance; contacts hold displacements and forces in the frames of the bonds.
    bonds  Bonds
    near   Near, what blocks meet
    """
    parameters, properties, states, bounds = groups
    sides, normal, area, local, force = contacts
    blocks, drive = bodies[0], drives[0]
    for k in range(steps):
        n = first + k
        if not refresh(near, dt):
            return k
        place(None, blocks, dt, bonds.u)
        to_frames(bonds, local)
        sweep_groups(None, parameters, properties, states, 0, bounds, sides, normal, area, local, force)
        from_frames(bonds, force)
        press(near, dt)
        clock = dead_load[n + 1], dead_load[n], speed[n + 1], speed[n]
        move(None, blocks, dt, damping, clock, bonds.force, bonds.u)
        drive_force[k] = reaction(blocks, drive)
        pull(blocks, drive, speed[n + 1])
    return steps
