"""How far two convex pieces are apart along the axes that can part them: normals of faces, crossed edges.

Everything is seen from the position of the first piece's body; d is the position of the second one's body from there.
"""

from math import sqrt

from masonry.jit.compiler import inlined, inner

PARALLEL = 1e-6
"""Sine of the angle below which two edges have no axis of their own."""


@inlined
def lowest(vertex, first, last, nx, ny, nz):
    """The least height n . x of some corners."""
    minimum = nx * vertex[first, 0] + ny * vertex[first, 1] + nz * vertex[first, 2]
    for v in range(first + 1, last):
        minimum = min(minimum, nx * vertex[v, 0] + ny * vertex[v, 1] + nz * vertex[v, 2])
    return minimum


@inlined
def face_gap(normal, offset, f, vertex, first, last, dx, dy, dz):
    """How far (m) corners first..last, at d from the body of face f, stand above it; < 0 where some are below."""
    nx, ny, nz = normal[f, 0], normal[f, 1], normal[f, 2]
    return lowest(vertex, first, last, nx, ny, nz) + (nx * dx + ny * dy + nz * dz) - offset[f]


@inlined
def height(normal, offset, f, x, y, z):
    """Height (m) of a point above face f, both from the position of its body."""
    return normal[f, 0] * x + normal[f, 1] * y + normal[f, 2] * z - offset[f]


@inlined
def most_facing(normal, offset, inner, first, last, vertex, corner, corner_end, nx, ny, nz, tie, present, hold):
    """Of the free faces at the corner that is lowest along n, or of all where there are none, the one whose normal is
    most against n.

    `present` (-1 for none) stays where it is at that corner and no other is by `hold` more so. A face that does not
    meet the lowest corner may look more against n: an overlap with it would leave out what is deepest.
    """
    deep = corner
    minimum = nx * vertex[corner, 0] + ny * vertex[corner, 1] + nz * vertex[corner, 2]
    for v in range(corner + 1, corner_end):
        along = nx * vertex[v, 0] + ny * vertex[v, 1] + nz * vertex[v, 2]
        if along < minimum:
            minimum, deep = along, v
    x, y, z = vertex[deep, 0], vertex[deep, 1], vertex[deep, 2]
    best, best_face, stays, meets = 2.0, -1, False, False
    for f in range(first, last):
        if inner[f]:
            continue
        here = height(normal, offset, f, x, y, z) >= -tie
        along = normal[f, 0] * nx + normal[f, 1] * ny + normal[f, 2] * nz
        stays = stays or (here and f == present)
        if (here and not meets) or (here == meets and along < best):
            best, best_face, meets = along, f, here
    if stays:
        along = normal[present, 0] * nx + normal[present, 1] * ny + normal[present, 2] * nz
        if along <= best + hold:
            return present
    return best_face


@inlined
def widest_face(
    normal, offset, inner, face_first, face_last, vertex, first, last, dx, dy, dz, x, y, z, threshold, inside
):  # fmt: skip
    """The free face with the widest gap to corners first..last of the other piece, if that is more than `threshold`.

    Returns it, its gap, whether a face inside the body parts the pieces, by a gap of more than `inside`, and whether an
    edge may (open_edges). (x, y, z) is a point of the other piece as it stands: no gap is wider than this point is
    high, so that most faces are told by one product. -1 where none is.
    """
    widest, parted, edges, minimum = -1, False, False, min(threshold, 0.0)
    for f in range(face_first, face_last):
        bound = height(normal, offset, f, x, y, z)
        edges = edges or bound > minimum
        if inner[f]:
            gap = bound if bound <= inside else face_gap(normal, offset, f, vertex, first, last, dx, dy, dz)
            parted = parted or gap > inside
        elif bound > threshold:
            gap = face_gap(normal, offset, f, vertex, first, last, dx, dy, dz)
            if gap > threshold:
                threshold, widest = gap, f
    return widest, threshold, parted, edges


@inner
def arc_height(height_1, height_2, cosine):
    """The greatest n . q of the unit vectors n from n_1 to n_2, for n_1 . q, n_2 . q and n_1 . n_2."""
    alpha, beta = height_1 - cosine * height_2, height_2 - cosine * height_1
    if alpha > 0.0 and beta > 0.0:
        return sqrt((alpha * height_1 + beta * height_2) / (1.0 - cosine * cosine))
    return max(height_1, height_2)


@inner
def open_edges(edge, first, last, normal, offset, x, y, z, threshold, count, edges):
    """Edges whose axes may part the pieces by more than `threshold`, for a point (x, y, z) of the other piece.

    count < 0: of all edges first..last; else of the `count` ones in edges, which is written over. Returns their number.
    """
    number = 0
    for k in range(last - first if count < 0 else count):
        e = first + k if count < 0 else edges[k]
        f, g = edge[e, 2], edge[e, 3]
        height_f, height_g = height(normal, offset, f, x, y, z), height(normal, offset, g, x, y, z)
        if height_f <= threshold and height_g <= threshold and height_f <= 0.0 and height_g <= 0.0:
            continue
        cosine = normal[f, 0] * normal[g, 0] + normal[f, 1] * normal[g, 1] + normal[f, 2] * normal[g, 2]
        if arc_height(height_f, height_g, cosine) > threshold:
            edges[number] = e
            number += 1
    return number


@inner
def edge_axis(edge, e, g, vertex, normal, dx, dy, dz):
    """Gap (m) and unit normal, from the first piece to the second, of two crossed edges whose arcs of normals cross.

    Returns (crosses, gap, nx, ny, nz); without a crossing of the arcs no face of the Minkowski difference is theirs.
    """
    p, q = edge[e, 0], edge[e, 1]
    r, s = edge[g, 0], edge[g, 1]
    ax, ay, az = vertex[q, 0] - vertex[p, 0], vertex[q, 1] - vertex[p, 1], vertex[q, 2] - vertex[p, 2]
    bx, by, bz = vertex[s, 0] - vertex[r, 0], vertex[s, 1] - vertex[r, 1], vertex[s, 2] - vertex[r, 2]
    f1, f2, g1, g2 = edge[e, 2], edge[e, 3], edge[g, 2], edge[g, 3]
    a_g1 = -_along(normal, g1, ax, ay, az)  # the arc of the second piece is turned round: it looks the other way
    a_g2 = -_along(normal, g2, ax, ay, az)
    b_f1, b_f2 = _along(normal, f1, bx, by, bz), _along(normal, f2, bx, by, bz)
    if not (a_g1 * a_g2 < 0.0 and b_f1 * b_f2 < 0.0):
        return False, 0.0, 0.0, 0.0, 0.0
    nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    square = nx * nx + ny * ny + nz * nz
    if square <= PARALLEL * PARALLEL * (ax * ax + ay * ay + az * az) * (bx * bx + by * by + bz * bz):
        return False, 0.0, 0.0, 0.0, 0.0
    scale = 1.0 / sqrt(square)
    if _along(normal, f1, nx, ny, nz) + _along(normal, f2, nx, ny, nz) < 0.0:
        scale = -scale
    nx, ny, nz = scale * nx, scale * ny, scale * nz
    if _along(normal, g1, nx, ny, nz) + _along(normal, g2, nx, ny, nz) > 0.0:
        return False, 0.0, 0.0, 0.0, 0.0
    x, y, z = (
        vertex[r, 0] + dx - vertex[p, 0],
        vertex[r, 1] + dy - vertex[p, 1],
        vertex[r, 2] + dz - vertex[p, 2],
    )
    return True, nx * x + ny * y + nz * z, nx, ny, nz


@inner
def are_apart(vertex, va, va_end, vb, vb_end, dx, dy, dz, inside):
    """Whether two pieces are apart by more than `inside` (m, or overlap by less) across some pair of their edges.

    va..va_end, vb..vb_end  their corners. Any two corners count as an edge: so do those within the body, which have no
    contacts of their own. What is no edge parts no more than edges do.
    """
    for i in range(va, va_end - 1):
        for j in range(i + 1, va_end):
            ax, ay, az = vertex[j, 0] - vertex[i, 0], vertex[j, 1] - vertex[i, 1], vertex[j, 2] - vertex[i, 2]
            for k in range(vb, vb_end - 1):
                for m in range(k + 1, vb_end):
                    bx, by, bz = vertex[m, 0] - vertex[k, 0], vertex[m, 1] - vertex[k, 1], vertex[m, 2] - vertex[k, 2]
                    nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
                    size, between = sqrt(nx * nx + ny * ny + nz * nz), nx * dx + ny * dy + nz * dz
                    gap_forth = (
                        lowest(vertex, vb, vb_end, nx, ny, nz) + lowest(vertex, va, va_end, -nx, -ny, -nz) + between
                    )
                    gap_back = (
                        lowest(vertex, va, va_end, nx, ny, nz) + lowest(vertex, vb, vb_end, -nx, -ny, -nz) - between
                    )
                    if max(gap_forth, gap_back) > inside * size and size > 0.0:
                        return True
    return False


@inner
def _along(normal, f, x, y, z):
    return normal[f, 0] * x + normal[f, 1] * y + normal[f, 2] * z
