"""Vectors and planes that are fixed in blocks, in space and back, whether a block only turns or deforms as well."""

from math import sqrt

from masonry.jit.compiler import inner, jit


@inner
def turned(frame, b, x, y, z):
    """A vector in the frame of a block, in space."""
    return (
        frame[b, 0, 0] * x + frame[b, 0, 1] * y + frame[b, 0, 2] * z,
        frame[b, 1, 0] * x + frame[b, 1, 1] * y + frame[b, 1, 2] * z,
        frame[b, 2, 0] * x + frame[b, 2, 1] * y + frame[b, 2, 2] * z,
    )


@jit
def plane_of(frame, dual, b, x, y, z):
    """The unit normal in space of a plane that is fixed in block b, and the factor of its level there.

    x, y, z  the normal in the frame of the block: F^T n of the unit normal n that it had when the level was found
    """
    if dual is None:
        nx, ny, nz = turned(frame, b, x, y, z)
        return nx, ny, nz, 1.0
    nx, ny, nz = turned(dual, b, x, y, z)
    scale = 1.0 / sqrt(nx * nx + ny * ny + nz * nz)
    return scale * nx, scale * ny, scale * nz, scale


@inner
def into(frame, dual, b, x, y, z):
    """A vector in space in the frame of a block: F^-1 times it."""
    back = frame if dual is None else dual
    return (
        back[b, 0, 0] * x + back[b, 1, 0] * y + back[b, 2, 0] * z,
        back[b, 0, 1] * x + back[b, 1, 1] * y + back[b, 2, 1] * z,
        back[b, 0, 2] * x + back[b, 1, 2] * y + back[b, 2, 2] * z,
    )
