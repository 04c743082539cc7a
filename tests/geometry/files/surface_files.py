"""Small OBJ files for tests: hexahedra, and what is wrong with them."""

import numpy as np

CUBE = ((1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8))
"""Faces of a hexahedron by the numbers of its corners, as corners() has them."""


def corners(low=(0.0, 0.0, 0.0), size=(1.0, 1.0, 1.0)):
    unit = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    return np.array(low) + np.array(unit) * np.array(size)


def obj(path, *bodies, faces=CUBE, head="o body{0}"):
    lines, count = [], 0
    for number, points in enumerate(bodies):
        lines += [head.format(number)] if head else []
        lines += ["v {!r} {!r} {!r}".format(*point) for point in np.asarray(points, dtype=float).tolist()]
        lines += ["f " + " ".join(str(v + count) for v in face) for face in faces]
        count += len(points)
    path.write_text("\n".join(lines) + "\n")
    return path
