"""The common plane of two convex pieces, and where they touch.

The common plane lies across the axis along which the pieces overlap least, or are farthest apart: a normal of a face,
or of two edges whose arcs of normals cross. Two faces: n is the normal of the one that leaves the wider gap to the
other piece; where both leave the same one (blocks of one size on each other) the mean of both; between them the weight
changes within BLEND of the smaller radius, so that n does not jump. Whether an axis is the best is proven by points of
the overlap: no axis parts two pieces by more than it parts a point of one from a point of the other.

A pair is worked on in the order of the pieces' `rank`: exchanged, it gives the same bits, n and the kinds of features
turned round.
"""

from math import inf, sqrt

from masonry.detection.axes import are_apart, edge_axis, face_gap, most_facing, open_edges, widest_face
from masonry.detection.clip import area_and_centroid
from masonry.detection.contact_points import corner_point, crossing_point, polygon_points
from masonry.detection.overlap import beside, common_plane, heights, overlap, point_of
from masonry.detection.pieces import SNAP
from masonry.jit.compiler import inlined, inner

NONE, FACE, EDGE = 0, 1, 2
"""Kinds: no contact; two faces, or a face and an edge or corner; two crossed edges."""
BLEND = 1e-3
"""Of the smaller radius: difference of the gaps of two faces over which n turns from one normal to the other."""
MOVED = 0.01
"""Of the size of a patch: motion of its two sides against each other after which it is clipped anew."""
BETWEEN = 0.1
"""Of the size of a patch: what motions are compared with while n lies between two normals."""
HOLD = 0.1
"""Of the gap or depth: by how much another axis must be better before it takes the place of the present one."""
MISSED = 0.5
"""Of the depth: where the overlap of two faces is nowhere deeper than that, their axis is not held."""
HOLD_FACING = 0.02
"""Cosine by which another face must look more against n."""
FACING = 0.3
"""Cosine by which two faces must look against each other where tets touch, which have no other faces to do so."""
ROUNDS = 4
"""Pairs of faces that are tried one after the other, each better than the last."""
FLAT, FLAT_HELD = 0.995, 0.998
"""Cosine between n and the axis of two edges: nearer ones are part of the overlap of two faces; while they touch."""
ROUND_OFF = 1e-9
"""Of the smaller radius: axes that are as good as each other."""


@inner
def touch(
    pieces, turned, position, p, q, skin, reach, minimum_area, fixed, axis, witness, scratch, point, gap, area, feature
):  # fmt: skip
    """Where pieces p and q touch. Returns (kind, count, separation, blend, size).

    position         (N, 3) m of the bodies; `turned` holds their pieces (placing.py)
    skin             m: beyond this gap there is no contact, and no more is looked at
    reach            m: the overlap is cut where the gap is wider than this
    minimum_area     m2: area of crossed edges, and the least one that a cut overlap keeps
    fixed            whether they touch with the two faces of `witness` or not at all, whatever parts them more
    axis             (3,) written: n from p to q
    witness          (3,) kind and faces or edges of the last call, which speed up this one; -1 at first; written
    point, gap, area, feature  (K, 3) m, (K,) m, (K,) m2, (K,): written; K >= most_points(pieces)
    separation       m along n, < 0 where the pieces overlap; where they do not, no more than their distance
    blend            weight of p's normal in n
    size             m, root of the area of the overlap: what motions are compared with; a tenth of that where n lies
                     between two normals, since a tilt may soon turn it to one of them; and so small that what was
                     cut away cannot close before the pair is clipped anew. Without contact, of tets or fixed faces:
                     how far they are apart sideways, 0 where that is not known
    """
    rank = pieces.rank
    body = pieces.body
    if rank[p] <= rank[q]:
        a, b, wa, wb = p, q, witness[1], witness[2]
    else:
        a, b, wa, wb = q, p, witness[2], witness[1]
    i, j = body[a], body[b]
    dx, dy, dz = position[j, 0] - position[i, 0], position[j, 1] - position[i, 1], position[j, 2] - position[i, 2]
    kind, count, separation, blend, size, fa, fb, nx, ny, nz = _ordered(
        a, b, dx, dy, dz, skin, reach, minimum_area, fixed, witness[0], wa, wb,
        pieces.vertex_start, pieces.face_start, pieces.loop_start, pieces.loop, pieces.inner,
        pieces.edge_start, pieces.edge, pieces.radius, pieces.snap,
        turned.vertex, turned.centre, turned.normal, turned.offset,
        scratch.u, scratch.v, scratch.label, scratch.wu, scratch.wv, scratch.weight, scratch.name, scratch.edges,
        point, gap, area, feature,
    )  # fmt: skip
    for k in range(count):
        point[k, 0] += position[i, 0]
        point[k, 1] += position[i, 1]
        point[k, 2] += position[i, 2]
    size = min(size, 0.5 * reach / MOVED)
    witness[0] = kind
    if a == p:
        axis[0], axis[1], axis[2], witness[1], witness[2] = nx, ny, nz, fa, fb
    else:
        axis[0], axis[1], axis[2], witness[1], witness[2], blend = -nx, -ny, -nz, fb, fa, 1.0 - blend
    return kind, count, separation, blend, size


@inlined
def _ordered(
    a, b, dx, dy, dz, skin, reach, minimum_area, fixed, known, fa, fb,
    vertex_start, face_start, loop_start, loop, inner, edge_start, edge, radius, snaps, vertex, centre, normal, offset,
    u, v, label, wu, wv, weight, name, edges, point, gap, area, feature,
):  # fmt: skip
    """`touch` for pieces in the order of their ranks, points from the first body's position."""
    va, va_end, vb, vb_end = vertex_start[a], vertex_start[a + 1], vertex_start[b], vertex_start[b + 1]
    la, la_end, lb, lb_end = face_start[a], face_start[a + 1], face_start[b], face_start[b + 1]
    small = min(radius[a], radius[b])
    snap, tie = max(snaps[a], snaps[b]) * small, ROUND_OFF * small
    of_tets = snap > SNAP * small
    ax, ay, az = centre[a, 0], centre[a, 1], centre[a, 2]
    bx, by, bz = centre[b, 0] + dx, centre[b, 1] + dy, centre[b, 2] + dz
    if known == EDGE or fa < 0 or fb < 0:
        fa, fb = _first_faces(
            normal, offset, inner, la, la_end, lb, lb_end, vertex, va, va_end, vb, vb_end, dx, dy, dz,
            ax, ay, az, bx, by, bz, tie,
        )  # fmt: skip
        if fa < 0:  # a piece in the middle of its body
            return NONE, 0, inf, 0.5, 0.0, -1, -1, 0.0, 0.0, 0.0
    for _ in range(ROUNDS):
        gap_a = face_gap(normal, offset, fa, vertex, vb, vb_end, dx, dy, dz)
        gap_b = face_gap(normal, offset, fb, vertex, va, va_end, -dx, -dy, -dz)
        face, other = _pair_of(
            normal, offset, inner, fa, fb, la, la_end, lb, lb_end, vertex, va, va_end, vb, vb_end, tie,
            gap_a >= gap_b, True,
        )  # fmt: skip
        if face != fa or other != fb:
            fa, fb = face, other
            gap_a = face_gap(normal, offset, fa, vertex, vb, vb_end, dx, dy, dz)
            gap_b = face_gap(normal, offset, fb, vertex, va, va_end, -dx, -dy, -dz)
        wide = max(gap_a, gap_b)
        if of_tets and _along(normal, fa, fb) >= -FACING:
            return NONE, 0, wide, 0.5, 0.0, fa, fb, 0.0, 0.0, 0.0
        blend, nx, ny, nz = _between(normal, fa, fb, (gap_a - gap_b) / (BLEND * small))
        if wide > skin:
            return NONE, 0, wide, blend, 0.0, fa, fb, nx, ny, nz
        plane = common_plane(vertex, loop, loop_start, normal, offset, fa, fb, dx, dy, dz, nx, ny, nz)
        row, count = overlap(vertex, loop, loop_start, fa, fb, dx, dy, dz, plane, snap, u, v, label, weight, wu, wv)
        full, cu, cv = area_and_centroid(u, v, row, count) if count >= 3 else (0.0, 0.0, 0.0)
        if fixed:
            threshold, edges_too = wide, False
            break
        if full > 0.0:
            low, high = heights(plane, cu, cv)
            ax, ay, az = point_of(plane, cu, cv, low)
            bx, by, bz = point_of(plane, cu, cv, high)
        hold = HOLD * abs(wide)
        if wide < 0.0 and (full <= 0.0 or _deepest(u, v, row, count, plane, wide)[2] > MISSED * wide):
            hold = 0.0  # what is deepest lies beside these two faces
        threshold, inside = wide + hold + tie, min(0.5 * wide, 0.0)
        other, gap_a, parted, edges_too = widest_face(
            normal, offset, inner, la, la_end, vertex, vb, vb_end, dx, dy, dz, bx, by, bz, threshold, inside
        )
        another, gap_b, also, _ = widest_face(
            normal, offset, inner, lb, lb_end, vertex, va, va_end, -dx, -dy, -dz, ax - dx, ay - dy, az - dz, gap_a,
            inside,
        )  # fmt: skip
        if parted or also:
            return NONE, 0, wide, blend, 0.0, fa, fb, nx, ny, nz
        if another < 0 and other < 0:
            break
        fa, fb = _pair_of(
            normal, offset, inner, other, another, la, la_end, lb, lb_end, vertex, va, va_end, vb, vb_end, tie,
            another < 0, False,
        )  # fmt: skip
    flat = FLAT_HELD if known == EDGE else FLAT
    if not fixed and (known == EDGE or full <= 0.0):  # edges that touch already, or that must, as the two faces do not
        threshold, edges_too = wide - HOLD * abs(wide) - tie, True
    ea, eb, apart, ex, ey, ez = -1, -1, threshold, 0.0, 0.0, 0.0
    if edges_too:
        ea, eb, apart, ex, ey, ez = _crossed(
            a, b, dx, dy, dz, ax, ay, az, bx, by, bz, threshold, flat, full > 0.0, u, v, row, count, plane, wide,
            edge_start, edge, vertex, normal, offset, edges,
        )  # fmt: skip
    if ea >= 0 and apart > skin:
        return NONE, 0, apart, blend, 0.0, fa, fb, nx, ny, nz
    if ea >= 0:
        crossings = crossing_point(
            vertex, edge, edge_start[a], edge_start[b], ea, eb, dx, dy, dz, ex, ey, ez, apart, minimum_area,
            point, gap, area, feature,
        )  # fmt: skip
        if crossings:
            return EDGE, crossings, apart, 0.5, sqrt(minimum_area), ea, eb, ex, ey, ez
    if full <= 0.0:
        depth = max(wide, apart) if ea >= 0 else wide
        if depth >= 0.0 or of_tets or fixed:  # a corner of a mesh belongs to several tets
            lateral = beside(vertex, loop, loop_start, fa, fb, dx, dy, dz, plane) if of_tets or fixed else 0.0
            return NONE, 0, depth, blend, lateral, fa, fb, nx, ny, nz
        _corner_of_one(
            vertex, va, va_end, vb, vb_end, dx, dy, dz, nx, ny, nz, depth, minimum_area, fa - la, fb - lb, blend,
            point, gap, area, feature,
        )  # fmt: skip
        return FACE, 1, depth, blend, sqrt(minimum_area), fa, fb, nx, ny, nz
    if of_tets and _along(normal, fa, fb) > -FLAT and are_apart(vertex, va, va_end, vb, vb_end, dx, dy, dz, inside):
        return NONE, 0, wide, blend, 0.0, fa, fb, nx, ny, nz
    count = polygon_points(
        u, v, label, row, count, full, plane, snap, reach, minimum_area, fa - la, fb - lb, weight, name,
        point, gap, area, feature,
    )  # fmt: skip
    size = sqrt(full) if blend in (0.0, 1.0) else BETWEEN * sqrt(full)
    return (FACE if count else NONE), count, wide, blend, size, fa, fb, nx, ny, nz


@inlined
def _first_faces(
    normal, offset, inner, la, la_end, lb, lb_end, vertex, va, va_end, vb, vb_end, dx, dy, dz,
    ax, ay, az, bx, by, bz, tie,
):  # fmt: skip
    """The faces of two pieces of which nothing is known; -1 where one of them has no free face."""
    fa, gap_a, _, _ = widest_face(
        normal, offset, inner, la, la_end, vertex, vb, vb_end, dx, dy, dz, bx, by, bz, -inf, 0.0
    )
    fb, gap_b, _, _ = widest_face(
        normal, offset, inner, lb, lb_end, vertex, va, va_end, -dx, -dy, -dz, ax - dx, ay - dy, az - dz, -inf, 0.0
    )
    if fa < 0 or fb < 0:
        return -1, -1
    return _pair_of(
        normal, offset, inner, fa, fb, la, la_end, lb, lb_end, vertex, va, va_end, vb, vb_end, tie,
        gap_a >= gap_b, False,
    )  # fmt: skip


@inlined
def _corner_of_one(
    vertex, va, va_end, vb, vb_end, dx, dy, dz, nx, ny, nz, depth, minimum_area, fa, fb, blend,
    point, gap, area, feature,
):  # fmt: skip
    """Write the one point where a corner meets a face, the one of the two that n comes from."""
    if blend >= 0.5:
        corner_point(
            vertex, vb, vb_end, dx, dy, dz, nx, ny, nz, 1.0, depth, minimum_area, fa, point, gap, area, feature
        )  # fmt: skip
    else:
        corner_point(
            vertex, va, va_end, 0.0, 0.0, 0.0, nx, ny, nz, -1.0, depth, minimum_area, fb, point, gap, area, feature
        )  # fmt: skip


@inlined
def _pair_of(
    normal, offset, inner, fa, fb, la, la_end, lb, lb_end, vertex, va, va_end, vb, vb_end, tie, first, holds
):  # fmt: skip
    """One of two faces, the first or the second, with the face of the other piece's deepest corner that looks most
    against it.

    holds: the other one of the two stays where no face looks more against it by HOLD_FACING.
    """
    if first:
        x, y, z, present = normal[fa, 0], normal[fa, 1], normal[fa, 2], fb if holds else -1
        return fa, most_facing(
            normal, offset, inner, lb, lb_end, vertex, vb, vb_end, x, y, z, tie, present, HOLD_FACING
        )  # fmt: skip
    x, y, z, present = normal[fb, 0], normal[fb, 1], normal[fb, 2], fa if holds else -1
    return most_facing(
        normal, offset, inner, la, la_end, vertex, va, va_end, x, y, z, tie, present, HOLD_FACING
    ), fb  # fmt: skip


@inlined
def _along(normal, fa, fb):
    """Cosine between the normals of two faces: -1 where they look against each other."""
    return normal[fa, 0] * normal[fb, 0] + normal[fa, 1] * normal[fb, 1] + normal[fa, 2] * normal[fb, 2]


@inlined
def _between(normal, fa, fb, lead):
    """Weight of the normal of face fa, which leads the other one, and the unit normal between both."""
    blend = min(max(0.5 + 0.5 * lead, 0.0), 1.0)
    nx = blend * normal[fa, 0] - (1.0 - blend) * normal[fb, 0]
    ny = blend * normal[fa, 1] - (1.0 - blend) * normal[fb, 1]
    nz = blend * normal[fa, 2] - (1.0 - blend) * normal[fb, 2]
    scale = 1.0 / sqrt(nx * nx + ny * ny + nz * nz)
    return blend, scale * nx, scale * ny, scale * nz


@inner
def _crossed(
    a, b, dx, dy, dz, ax, ay, az, bx, by, bz, threshold, flat, overlaps, u, v, row, count, plane, wide,
    edge_start, edge, vertex, normal, offset, edges,
):  # fmt: skip
    """The two edges whose axis parts the pieces by more than `threshold`, and most; their gap and axis; -1 without any.

    (ax, ay, az), (bx, by, bz): a point of each piece. Edges that nearly lie in two faces add nothing to the corners of
    their overlap, unless all these are deeper than the edges are.
    """
    edges_a, edges_b = edges[0], edges[1]
    ea, eb, ex, ey, ez = -1, -1, 0.0, 0.0, 0.0
    count_a = open_edges(edge, edge_start[a], edge_start[a + 1], normal, offset, bx, by, bz, threshold, -1, edges_a)
    if count_a == 0:
        return ea, eb, threshold, ex, ey, ez
    count_b = open_edges(
        edge, edge_start[b], edge_start[b + 1], normal, offset, ax - dx, ay - dy, az - dz, threshold, -1, edges_b
    )
    deep = wide
    if overlaps and count_b > 0:
        du, dv, deep = _deepest(u, v, row, count, plane, wide)
        low, high = heights(plane, du, dv)
        x, y, z = point_of(plane, du, dv, high)
        count_a = open_edges(edge, 0, 0, normal, offset, x, y, z, threshold, count_a, edges_a)
        x, y, z = point_of(plane, du, dv, low)
        count_b = open_edges(edge, 0, 0, normal, offset, x - dx, y - dy, z - dz, threshold, count_b, edges_b)
    for k in range(count_a):
        for m in range(count_b):
            crosses, apart, x, y, z = edge_axis(edge, edges_a[k], edges_b[m], vertex, normal, dx, dy, dz)
            if crosses and apart > threshold:
                along = x * plane.nx + y * plane.ny + z * plane.nz
                if not overlaps or along < flat or apart > deep + HOLD * abs(deep):
                    threshold, ea, eb, ex, ey, ez = apart, edges_a[k], edges_b[m], x, y, z
    return ea, eb, threshold, ex, ey, ez


@inner
def _deepest(u, v, row, count, plane, wide):
    """The middle of the corners of an overlap that are within a hair as deep as the deepest one, and that one's gap."""
    minimum = inf
    for k in range(count):
        low, high = heights(plane, u[row, k], v[row, k])
        minimum = min(minimum, high - low)
    mu, mv, number = 0.0, 0.0, 0
    for k in range(count):
        low, high = heights(plane, u[row, k], v[row, k])
        if high - low <= minimum + 0.5 * HOLD * abs(wide):
            mu, mv, number = mu + u[row, k], mv + v[row, k], number + 1
    return mu / number, mv / number, minimum
