"""The arch: voussoirs cut from a circular ring by plane joints that point at its centre, between two abutments."""

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import extrude
from geometry.polyhedra.overlaps import check_overlaps


def arch(radius: float, angle: float, voussoirs: int, thickness: float, depth: float) -> Specimen:
    """Equal voussoirs in an upright plane, the crown at the top; intrados and extrados are polygons.

    radius     m, of the centre line, midway between intrados and extrados; the joints end on these two circles
    angle      rad, of embrace, from springing to springing: above 0, up to pi for a semicircle
    voussoirs  2 or more
    thickness  m, along the joints, less than the radius
    depth      m, along y

    The centre of the circle is at x = z = 0. Voussoirs come from left to right, then the left and the right abutment:
    a block as thick and as deep as the arch that goes on beyond the springing, square to it, by half the thickness.
    Sets "voussoirs", "keystone" (the voussoir at the crown; both of them where their number is even), "left abutment",
    "right abutment". The section is that of a joint, thickness * depth. Raises GeometryError for what cannot be built.
    """
    require_lengths("arch", {"radius": radius, "thickness": thickness, "depth": depth})
    _require(radius, angle, voussoirs, thickness)
    ends = _joints(radius, angle, voussoirs, thickness)
    loops = [np.stack([low[0], high[0], high[1], low[1]]) for low, high in zip(ends[:-1], ends[1:], strict=True)]
    beyond = 0.5 * thickness * np.array([np.cos(0.5 * angle), np.sin(0.5 * angle)])
    left, right = beyond * (-1.0, -1.0), beyond * (1.0, -1.0)
    loops.append(np.stack([ends[0, 0] + left, ends[0, 0], ends[0, 1], ends[0, 1] + left]))
    loops.append(np.stack([ends[-1, 0], ends[-1, 0] + right, ends[-1, 1] + right, ends[-1, 1]]))
    number = len(loops)
    blocks = extrude(loops, np.zeros(number), np.full(number, depth), np.arange(number), ("units",))
    check_overlaps(blocks)
    sets = {
        "voussoirs": np.arange(voussoirs),
        "keystone": np.arange((voussoirs - 1) // 2, voussoirs // 2 + 1),
        "left abutment": np.array([voussoirs]),
        "right abutment": np.array([voussoirs + 1]),
    }
    return Specimen(blocks, sets, section=thickness * depth, shape="arch")


def _joints(radius: float, angle: float, voussoirs: int, thickness: float) -> np.ndarray:
    """(n + 1, 2, 2) m: x, z of the inner and the outer end of each joint, from left to right."""
    from_crown = angle * (np.arange(voussoirs + 1) / voussoirs - 0.5)
    way = np.stack([np.sin(from_crown), np.cos(from_crown)], axis=1)
    circles = radius + thickness * np.array([-0.5, 0.5])
    return np.asarray(circles[None, :, None] * way[:, None, :])


def _require(radius: float, angle: float, voussoirs: int, thickness: float) -> None:
    """What lengths alone do not say."""
    require_counts("arch", "number of voussoirs", (voussoirs,), "x")
    if voussoirs < 2:
        raise GeometryError("arch: number of voussoirs is 1, it must be 2 or more; nearest: 2")
    if not 0.0 < angle <= np.pi:
        raise GeometryError(
            f"arch: angle is {np.degrees(angle):g} deg, it must be above 0 and up to 180 deg (a semicircle); "
            "nearest: 180 deg"
        )
    if thickness >= radius:
        raise GeometryError(
            f"arch: thickness is {thickness:g} m, it must be less than the radius of the centre line, {radius:g} m"
        )
