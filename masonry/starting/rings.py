"""Rings of arches by span and rise of their intrados: the circle, and how many voussoirs are usual."""

import math


def ring_of(span: float, rise: float) -> tuple[float, float]:
    """Radius of the intrados (m) and angle of embrace (rad); lengths in m."""
    return (0.25 * span**2 + rise**2) / (2.0 * rise), min(4.0 * math.atan2(rise, 0.5 * span), math.pi)


def voussoirs_of(span: float, rise: float, thickness: float) -> int:
    """An odd number, so that there is a keystone: about two thirds as wide as thick, 11 to 41."""
    radius, angle = ring_of(span, rise)
    return min(41, max(11, 2 * round(0.5 * (radius + 0.5 * thickness) * angle / (0.66 * thickness)) + 1))
