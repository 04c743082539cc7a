"""A limit analysis in words, for a terminal."""

from math import inf

import numpy as np

from masonry.judgement.words import stress_text
from masonry.limit_analysis.limit_data import LimitData, set_of
from masonry.limit_analysis.positions import FactorEnvelope
from masonry.runtime.tables import Rows, aligned

EVERY = "none: joints that dilate balance every factor"


def result_text(result: LimitData) -> str:
    """Text that `masonry limit` prints."""
    return aligned(result_rows(result))


def result_rows(result: LimitData) -> Rows:
    """A word and its lines for each row that `masonry limit` prints."""
    moving = int(result.moving.sum())
    rows: Rows = [
        ("scene", [result.title]),
        ("assumed", [result.assumed]),
        (head_of(result), [factor_words(result) + _angle(result)]),
        ("of", [result.words]),
        ("which is", [result.bound]),
    ]
    if result.envelope is not None:
        rows.insert(4, ("least of", _positions(result.envelope)))
    if result.least is not None:
        section = result.specimen.section
        rows.insert(
            3,
            (
                "lowest stress",
                [f"{stress_text(result.least / section, section)}; between both there is an equilibrium"],
            ),
        )
    if result.with_dilation is not None:
        some = f"{result.with_dilation:.6g}: so much joints balance that dilate as they slide"
        every = "none: joints that dilate balance it with the least friction" if result.is_safety else EVERY
        rows.append(("with dilation", [every if result.with_dilation == inf else some]))
    if result.steps is not None and result.open is not None:
        rows.append(("reached in", [f"{result.steps} steps; the normal forces at the end bear {result.open:.1e} more"]))
        rows.append(("friction", [f"is exceeded by at most {result.excess:.1e} of the mean load of a block"]))
    rows += [
        (
            "duality gap",
            [f"{result.gap:.1e}; what is left on a block {result.unbalance:.1e} of its own loads"],
        ),
        ("solved as", [f"{result.method}, in {result.seconds:.2f} s"]),
        (
            "contacts",
            [f"{len(result.joints.area)} points in {len(result.joints.patch_start) - 1} joints: {result.points}"],
        ),
        ("mechanism", [f"{moving} of {result.specimen.blocks.count} blocks move" + _fastest(result)]),
    ]
    rows += [(element.name, [element.words]) for element in result.elements]
    if result.remarks:
        rows.append(("mind", result.remarks))
    return rows


def head_of(result: LimitData) -> str:
    """Name of the factor; for a force of the drive, that of the peak that a run finds."""
    if result.is_safety:
        return "factor of safety"
    return "peak stress" if result.unit == "N" else "load factor"


def factor_words(result: LimitData) -> str:
    """The factor; of a force of the drive as a run tells its peak."""
    if result.unit == "N":
        return stress_text(result.factor / result.specimen.section, result.specimen.section)
    return f"{result.factor:.6g} {result.unit}".rstrip()


def _angle(result: LimitData) -> str:
    """The angle of a tilt."""
    tilts = "tangent of the angle" in result.words and not result.is_safety
    return f", at {np.degrees(np.arctan(result.factor)):.4f} deg" if tilts else ""


def _positions(envelope: FactorEnvelope) -> list[str]:
    """Over how many positions a factor is the least, how surely, and how a run has it."""
    position = envelope.position
    gap = 1.0 - envelope.bound / max(float(envelope.factor.min()), 1e-300)
    lead = "" if len(set(envelope.direction)) == 1 else f" --set vehicle.direction={envelope.direction[envelope.least]}"
    return [
        f"{len(position)} positions from {position.min():.4g} m to {position.max():.4g} m; between them no mechanism "
        f"of theirs gives less, to {max(gap, 1e-6):.0e}",
        f"a run there: --set 'vehicle.position={position[envelope.least]:.4f} m'{lead} --set limit.accuracy=0.01",
    ]


def _fastest(result: LimitData) -> str:
    """Which block moves fastest, and a set that it is in."""
    if not result.moving.any():
        return ""
    block = int(np.argmax(result.speeds()))
    name = set_of(result.specimen, block)
    return f"; fastest is block {block}" + (f" of '{name}'" if name else "")
