"""Cameras: parallel projections of a specimen from the front, from behind, or from the front, the right and above."""

from dataclasses import dataclass, replace

import numpy as np

VIEWS = ("front", "back", "iso")
UPRIGHT = ("arch",)
"""Shapes of specimens that are seen along y however deep they are."""
AZIMUTH, ELEVATION = np.radians(-55.0), np.radians(25.0)
"""From where "iso" looks, as matplotlib counts these angles."""


@dataclass(frozen=True)
class Camera:
    """Unit vectors (3,) to the right, up and toward the viewer, and the largest extent (m) of what is seen."""

    right: np.ndarray
    up: np.ndarray
    toward: np.ndarray
    size: float

    @property
    def along_an_axis(self) -> bool:
        """Whether it looks along x, y or z."""
        return bool(np.count_nonzero(self.toward) == 1)

    def project(self, points: np.ndarray) -> np.ndarray:
        """(..., 2) of (..., 3)."""
        return np.stack([points @ self.right, points @ self.up], axis=-1)


def camera_of(view: str, points: np.ndarray, shape: str = "") -> Camera:
    """The camera of one of VIEWS for a specimen with these corners (P, 3)."""
    return {"front": front_view, "back": back_view, "iso": iso_view}[view](points, shape)


def front_view(points: np.ndarray, shape: str = "") -> Camera:
    """Onto the two largest extents of points (P, 3); onto x and z where extents tie, and for UPRIGHT shapes."""
    extent = np.ptp(points, axis=0)
    preference = np.array([2e-9, 0.0, 1e-9]) * extent.max()
    right, up = (0, 2) if shape in UPRIGHT else sorted(np.argsort(-(extent + preference))[:2].tolist())
    axes = np.eye(3)
    return Camera(axes[right], axes[up], np.cross(axes[right], axes[up]), float(extent.max()))


def back_view(points: np.ndarray, shape: str = "") -> Camera:
    """The same plane from behind: coordinates grow to the left."""
    front = front_view(points, shape)
    return replace(front, right=-front.right, toward=-front.toward)


def iso_view(points: np.ndarray, shape: str = "") -> Camera:
    """From the front, the right-hand side and above, whatever the shape."""
    across, rise = np.cos(ELEVATION), np.sin(ELEVATION)
    toward = np.array([across * np.cos(AZIMUTH), across * np.sin(AZIMUTH), rise])
    right = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
    return Camera(right, np.cross(toward, right), toward, float(np.ptp(points, axis=0).max()))
