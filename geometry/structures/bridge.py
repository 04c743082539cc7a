"""The bridge: arches side by side between two abutments, on piers where they meet."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import extrude
from geometry.polyhedra.overlaps import check_overlaps
from geometry.structures.gathering import Gathering
from geometry.structures.rings import (
    crown,
    joints_of_ring,
    require_ring,
    ring_over,
    skewback_outlines,
    voussoir_outlines,
)


class BridgeArch(NamedTuple):
    """An arch of a bridge: span and rise of the intrados, m; thickness, m; number of voussoirs."""

    span: float
    rise: float
    thickness: float
    voussoirs: int


class Pier(NamedTuple):
    """Pier between two arches: width between them and height below their springings, m; number of courses."""

    width: float
    height: float
    courses: int


def bridge(arch: Sequence[BridgeArch], pier: Sequence[Pier], depth: float) -> Specimen:
    """Arches from left to right in an upright plane, whose intrados spring at z = 0, the first one at x = 0.

    arch   one or more
    pier   between each two of them; its uppermost course is cut to the springings of both arches
    depth  m, along y

    Voussoirs come arch by arch from left to right, then piers from the footing up, then the abutments. An abutment is a
    skewback, as of `arch`; a footing is one more course below its pier, to be held. Sets "arch 1", "arch 1 voussoir 1",
    ..., "arch 1 keystone"; "voussoirs"; "pier 1", "pier 1 springer", its uppermost course, "pier 1 footing"; "left
    abutment", "right abutment"; "foundations", abutments and footings; "extrados", voussoirs and springers, on which a
    fill lies. The section is that of a joint of the first arch. Raises GeometryError for what cannot be built.
    """
    require_lengths("bridge", {"depth": depth})
    if not arch or len(pier) != len(arch) - 1:
        raise GeometryError(f"bridge: {len(arch)} arches have {max(len(arch) - 1, 0)} piers; here are {len(pier)}")
    rings, offset = [], 0.0
    for k, ring in enumerate(arch):
        offset += pier[k - 1].width if k else 0.0
        rings.append(_joints(k + 1, ring) + np.array([offset + 0.5 * ring.span, 0.0]))
        offset += ring.span
    parts = Gathering()

    def add(outlines: list[np.ndarray], *names: str) -> np.ndarray:
        count = len(outlines)
        return parts.add(
            extrude(outlines, np.zeros(count), np.full(count, depth), np.arange(count), ("units",)), *names
        )

    for k, ends in enumerate(rings):
        voussoirs = add(voussoir_outlines(ends), f"arch {k + 1}", "voussoirs", "extrados")
        parts.sets |= {f"arch {k + 1} voussoir {n + 1}": voussoirs[[n]] for n in range(len(voussoirs))}
        parts.sets[f"arch {k + 1} keystone"] = voussoirs[crown(len(voussoirs))]
    for k, below in enumerate(pier):
        name, outlines = f"pier {k + 1}", _courses(k + 1, below, rings[k][-1], rings[k + 1][0])
        add(outlines[:1], f"{name} footing", "foundations")
        add(outlines[1:-1], name)
        add(outlines[-1:], name, f"{name} springer", "extrados")
    for side, outline in zip(("left", "right"), skewback_outlines(np.stack([rings[0][0], rings[-1][-1]])), strict=True):
        add([outline], f"{side} abutment", "foundations")
    blocks = parts.blocks()
    check_overlaps(blocks)
    return Specimen(blocks, parts.sets, section=arch[0].thickness * depth, shape="bridge")


def _joints(number: int, arch: BridgeArch) -> np.ndarray:
    """(n + 1, 2, 2) m: x and z of the ends of its joints, with x = 0 in its middle."""
    kind = f"bridge: arch {number}"
    require_lengths(kind, {"span": arch.span, "rise": arch.rise, "thickness": arch.thickness})
    if arch.rise > 0.5 * arch.span:
        raise GeometryError(
            f"{kind}: rise is {arch.rise:g} m, at most half of the span; nearest: {0.5 * arch.span:g} m"
        )
    radius, angle, level = ring_over(arch.span, arch.rise, arch.thickness)
    require_ring(kind, "voussoirs", radius, angle, arch.voussoirs, arch.thickness)
    return joints_of_ring(radius, angle, arch.voussoirs, arch.thickness, level)


def _courses(number: int, pier: Pier, before: np.ndarray, after: np.ndarray) -> list[np.ndarray]:
    """Outlines (n, 2) m of the courses of a pier, from its footing up, between the last joint (2, 2) m of the arch on
    its left and the first one of that on its right: inner and outer end."""
    kind = f"bridge: pier {number}"
    require_lengths(kind, {"width": pier.width, "height": pier.height})
    require_counts(kind, "number of courses", (pier.courses,), "z")
    needed = (before[1, 0] - before[0, 0]) + (after[0, 0] - after[1, 0])
    if needed > pier.width * (1.0 + 1e-9):
        raise GeometryError(
            f"{kind}: width is {pier.width:g} m, the rings of both arches need {needed:.6g} m where they spring from it"
        )
    x, rise = (before[0, 0], after[0, 0]), pier.height / pier.courses
    levels = rise * np.arange(-pier.courses - 1, 0)
    outlines = [np.array([[x[0], z], [x[1], z], [x[1], z + rise], [x[0], z + rise]]) for z in levels]
    head = [*outlines.pop()[:2], after[0], after[1], before[1], before[0]]
    return [
        *outlines,
        np.array([a for a, b in zip(head, [*head[1:], head[0]], strict=True) if np.ptp([a, b], 0).any()]),
    ]
