"""The explicit step, Fig. 2 of the paper on one screen: displace, contact stresses, forces, velocities.

Compiled for exactly the types that a scene uses: an absent part is None and leaves no code behind.
"""

from masonry.jit.compiler import inner, jit
from masonry.jit.extending import overload
from masonry.kernels import contact
from masonry.kinematics.dispatch import move, update_positions


@jit
def advance(parallel, first, steps, dt, damping, dead_load, speed, groups, contacts, bodies, drives, drive_force):
    """Run `steps` steps from step number `first`; all state is changed in place.

    damping    None, a number (xi of eq. 3) or Guided
    dead_load  (n + 1,) share of the dead load at step 0..n; above 1: 1 + share of what its bodies hold as its change
    speed      (n + 1,) velocity of the drive after step i, m/s
    groups     (parameters, joints, states, ranges), one entry per contact group; ranges (2 G,) its first contact and
               the one behind its last
    contacts   (sides, normal, area, u, force)
    bodies     (rigid, affine, tets), None where absent
    drives     (K, 2) row and number of the dofs that the drive moves, one array per kinematics or None
    drive_force  (steps,) out: force (N) that the drive exerts, after each step
    """
    parameters, joints, states, ranges = groups
    sides, normal, area, u, force = contacts
    rigid_blocks, affine_blocks, tet_blocks = bodies
    rigid_drive, affine_drive, tet_drive = drives
    for k in range(steps):
        n = first + k
        update_positions(parallel, rigid_blocks, dt, u)
        update_positions(parallel, affine_blocks, dt, u)
        update_positions(parallel, tet_blocks, dt, u)

        sweep_groups(parallel, parameters, joints, states, 0, ranges, sides, normal, area, u, force)

        loading = dead_load[n + 1], dead_load[n], speed[n + 1], speed[n]
        move(parallel, rigid_blocks, dt, damping, loading, force, u)
        move(parallel, affine_blocks, dt, damping, loading, force, u)
        move(parallel, tet_blocks, dt, damping, loading, force, u)

        drive_force[k] = (
            reaction(rigid_blocks, rigid_drive)
            + reaction(affine_blocks, affine_drive)
            + reaction(tet_blocks, tet_drive)
        )
        pull(rigid_blocks, rigid_drive, speed[n + 1])
        pull(affine_blocks, affine_drive, speed[n + 1])
        pull(tet_blocks, tet_drive, speed[n + 1])


@inner
def pull(body, dofs, speed):
    """Set the velocity of the driven dofs."""
    if dofs is None:
        return
    for k in range(len(dofs)):
        body.v[dofs[k, 0], dofs[k, 1]] = speed


@jit
def reaction(body, dofs):
    """Sum of the forces that hold the given dofs."""
    if dofs is None:
        return 0.0
    total = 0.0
    for k in range(len(dofs)):
        total += body.hold[dofs[k, 0], dofs[k, 1]]
    return total


def sweep_groups(parallel, parameters, joints, states, g, ranges, sides, normal, area, u, force):
    """Every contact group with its own compiled law."""
    for i, (numbers, joint, state) in enumerate(zip(parameters, joints, states, strict=True)):
        contact.sweep(parallel, numbers, joint, state, ranges[2 * i], ranges[2 * i + 1], sides, normal, area, u, force)


@overload(sweep_groups)
def _sweep_groups(parallel, parameters, joints, states, g, ranges, sides, normal, area, u, force):
    if len(parameters) == 0:
        return lambda parallel, parameters, joints, states, g, ranges, sides, normal, area, u, force: None

    def first_then_rest(parallel, parameters, joints, states, g, ranges, sides, normal, area, u, force):
        contact.sweep(
            *(parallel, parameters[0], joints[0], states[0], ranges[2 * g], ranges[2 * g + 1]),
            *(sides, normal, area, u, force),
        )
        sweep_groups(parallel, parameters[1:], joints[1:], states[1:], g + 1, ranges, sides, normal, area, u, force)

    return first_then_rest
