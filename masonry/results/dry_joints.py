"""Contacts that slid, opened or closed for good without damage: joints that never had a strength, so that none was
lost, and joints that crushed."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from masonry.quantity import convert
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

LEAST_DAMAGE = 0.05
"""Contacts with less damage are not shown as damaged."""
FRACTION = 0.01
"""Of the largest opening or slip in the frame: what moved by less is not told."""
PARTED = 0.5
"""Of the root of a joint's area: an opening or slip beyond which its two sides have nothing to do with each other."""
LEAST = 1e-12
"""Movements (m) up to this one are but rounding."""
NARROW = 1e-6
"""Movements (m) below this one are drawn as no crack: nothing that is measured on masonry sees them."""


def moved_undamaged(result: "ResultData", frame: Frame) -> np.ndarray:
    """(C,) which contacts have no damage, and yet slid or opened by more than their stress over their stiffness."""
    opened, slid = _moved(result, frame)
    return (frame.damage == 0.0) & (opened | slid)


def crushed(frame: Frame) -> np.ndarray:
    """(C,) which contacts closed for good, by more than they opened or slid unless they have no damage.

    Less than FRACTION of the largest closing is not told: a toe closes by far less than joints open.
    """
    if frame.crushing is None:
        return np.zeros(len(frame.opening), dtype=bool)
    threshold = max(FRACTION * float(frame.crushing.max(initial=0.0)), LEAST)
    sound = frame.damage <= LEAST_DAMAGE
    return np.asarray((frame.crushing > threshold) & (sound | (frame.crushing > frame.parted)))


def as_it_stands(result: "ResultData", frame: Frame) -> Frame:
    """The same frame, where the damage of law `friction` says what is open or has slid now.

    The law keeps that a contact opened or slid at any time, be it by rounding while the loads were small.
    """
    frame = without_parted(result, frame)
    laws = result.summary.law_by_group or {}
    dry = np.array([laws.get(name) == "friction" for name in result.joint_groups], dtype=bool)[result.joint_group]
    if not dry.any():
        return frame
    opened, slid = _moved(result, frame)
    return replace(
        frame,
        damage_tension=np.where(dry, opened, frame.damage_tension),
        damage_shear=np.where(dry, slid, frame.damage_shear),
    )


def all_dry(result: "ResultData") -> bool:
    """Whether no joint but those of law `friction` can be damaged: that knows no degrees of it, and is no crack."""
    laws = {(result.summary.law_by_group or {}).get(name) for name in result.joint_groups}
    return laws <= {"friction", "elastic"} and "friction" in laws


def without_parted(result: "ResultData", frame: Frame) -> Frame:
    """The same frame without damage in joints whose two sides have parted altogether: they are no crack any more."""
    joints = result.joints
    whole = np.bincount(joints.patch, joints.area, len(joints.patch_start) - 1)
    parted = np.hypot(frame.opening, frame.slip) > PARTED * np.sqrt(whole)[joints.patch]
    if not parted.any():
        return frame
    tension, shear = (np.where(parted, 0.0, damage) for damage in (frame.damage_tension, frame.damage_shear))
    opening, slip = (np.where(parted, 0.0, moved) for moved in (frame.opening, frame.slip))
    return replace(frame, damage_tension=tension, damage_shear=shear, opening=opening, slip=slip)


def _moved(result: "ResultData", frame: Frame) -> tuple[np.ndarray, np.ndarray]:
    """(C,) which contacts opened, and which slid, by more than their stress over their stiffness."""
    normal, shear = (_stiffness(result, key) for key in ("normal_stiffness", "shear_stiffness"))
    open_for_good = np.maximum(frame.opening, 0.0) - np.maximum(frame.normal_stress, 0.0) / normal
    with np.errstate(invalid="ignore"):  # a frictionless glue has no shear stiffness and no shear stress
        slid_for_good = frame.slip - np.abs(frame.shear_stress) / shear
    largest = float(frame.parted.max(initial=0.0))
    threshold = max(FRACTION * largest, LEAST)
    with np.errstate(invalid="ignore"):
        return open_for_good > threshold, slid_for_good > threshold


def _stiffness(result: "ResultData", key: str) -> np.ndarray:
    """(C,) Pa/m by contact; not a number where an older result does not say."""
    known = result.joint_properties.get(key)
    return (_by_scene(result, key) if known is None else known)[result.joint_group]


def _by_scene(result: "ResultData", key: str) -> np.ndarray:
    """(G,) Pa/m by contact group, from the text of the scene, as an older version has kept it alone."""
    try:
        contact = result.scene_table.get("contact", {})
        groups = [contact[name if name in contact else "default"] for name in result.joint_groups]
        return np.array([convert(group[key], "stiffness", key) for group in groups])
    except (ValueError, KeyError, TypeError, AttributeError):
        return np.full(len(result.joint_groups), np.nan)
