"""Rings of voussoirs in an upright plane: where their joints stand, and the outlines of voussoirs and abutments."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import extrude, from_faces


def require_ring(
    kind: str, what: str, radius: float, angle: float, count: float, thickness: float, minimum: int = 2
) -> None:
    """A ring that can be cut into `count` pieces, called `what`, or GeometryError."""
    require_lengths(kind, {"radius": radius, "thickness": thickness})
    require_counts(kind, f"number of {what}", (count,), "x")
    if count < minimum:
        raise GeometryError(f"{kind}: number of {what} is {count}, it must be {minimum} or more; nearest: {minimum}")
    if not 0.0 < angle <= np.pi:
        raise GeometryError(
            f"{kind}: angle is {np.degrees(angle):g} deg, it must be above 0 and up to 180 deg; nearest: 180 deg"
        )
    if thickness >= radius:
        raise GeometryError(
            f"{kind}: thickness is {thickness:g} m, it must be less than the radius of the centre line, {radius:g} m"
        )


def ring_over(span: float, rise: float, thickness: float) -> tuple[float, float, float]:
    """Radius of the centre line (m), angle of embrace (rad) and z of the centre (m) of a ring whose intrados springs at
    z = 0. Span and rise (m) are those of the intrados."""
    inner, angle = (0.25 * span**2 + rise**2) / (2.0 * rise), min(4.0 * float(np.arctan2(rise, 0.5 * span)), np.pi)
    return inner + 0.5 * thickness, angle, rise - inner


def joints_of_ring(radius: float, angle: float, count: int, thickness: float, level: float = 0.0) -> np.ndarray:
    """(n + 1, 2, 2) m: x, z of the inner and the outer end of each joint of n pieces, from left to right; the centre
    of the ring is at x = 0 and z = level (m)."""
    from_crown = angle * (np.arange(count + 1) / count - 0.5)
    direction = np.stack([np.sin(from_crown), np.cos(from_crown)], axis=1)
    circles = radius + thickness * np.array([-0.5, 0.5])
    ends = circles[None, :, None] * direction[:, None, :]
    return np.asarray(ends + np.array([0.0, level]) if level else ends)


def voussoir_outlines(ends: np.ndarray) -> list[np.ndarray]:
    """(4, 2) m between each two joints, x to z counter-clockwise."""
    return [np.stack([low[0], high[0], high[1], low[1]]) for low, high in zip(ends[:-1], ends[1:], strict=True)]


def abutment_outlines(ends: np.ndarray, angle: float) -> list[np.ndarray]:
    """(4, 2) m: the left and the right block that go on beyond the springings, square to them, by half a joint."""
    reach = 0.5 * np.linalg.norm(ends[0, 1] - ends[0, 0]) * np.array([np.cos(0.5 * angle), np.sin(0.5 * angle)])
    left_arm, right_arm = reach * (-1.0, -1.0), reach * (1.0, -1.0)
    return [
        np.stack([ends[0, 0] + left_arm, ends[0, 0], ends[0, 1], ends[0, 1] + left_arm]),
        np.stack([ends[-1, 0], ends[-1, 0] + right_arm, ends[-1, 1] + right_arm, ends[-1, 1]]),
    ]


def skewback_outlines(ends: np.ndarray) -> list[np.ndarray]:
    """(4, 2) m: the left and the right block below the springings, upright on both sides and level below."""
    outlines = []
    for inner, outer in (ends[0], ends[-1]):
        low = min(inner[1], outer[1]) - 0.5 * float(np.linalg.norm(outer - inner))
        outlines.append(np.array([inner, outer, [outer[0], low], [inner[0], low]]))
    outlines[1] = outlines[1][::-1]
    return outlines


def in_facets(
    ends: np.ndarray, facets: int, low: Sequence[float] | np.ndarray, high: Sequence[float] | np.ndarray
) -> Blocks:
    """Voussoirs whose intrados and extrados are so many straight pieces each, between y = low and high (n,) m.

    ends  (n * facets + 1, 2, 2) m, as `joints_of_ring` has them; every facets-th is a joint
    With more than one facet a voussoir is not convex: its front and back are a quadrilateral for each facet.
    """
    outlines = voussoir_outlines(ends)
    count = len(outlines) // facets
    if facets == 1:
        return extrude(outlines, np.asarray(low), np.asarray(high), np.arange(count), ("units",))
    bodies = [_faces(outlines[k * facets : (k + 1) * facets], float(low[k]), float(high[k])) for k in range(count)]
    return from_faces(bodies, list(range(count)), [0] * count, ("units",))


def _faces(outlines: Sequence[np.ndarray], low: float, high: float) -> list[np.ndarray]:
    """Of a body whose outline is these quadrilaterals side by side."""
    faces = []
    for outline in outlines:
        front, back = (np.insert(outline, 1, y, axis=1) for y in (low, high))
        faces += [front, back[::-1]]
        faces += [np.stack([front[j], front[i], back[i], back[j]]) for i, j in ((0, 1), (2, 3))]
    for outline, (i, j) in ((outlines[0], (3, 0)), (outlines[-1], (1, 2))):
        front, back = (np.insert(outline, 1, y, axis=1) for y in (low, high))
        faces.append(np.stack([front[j], front[i], back[i], back[j]]))
    return faces


def crown(count: int) -> np.ndarray:
    """Numbers of the pieces at the crown: one, or both beside it where their number is even."""
    return np.arange((count - 1) // 2, count // 2 + 1)
