"""Values of random scenes as a scene has them."""

import numpy as np

Draw = np.random.Generator
LAWS = ("brittle", "linear", "exponential")


def length(draw: Draw, low: float, high: float) -> str:
    """Between two lengths in m."""
    return f"{1e3 * draw.uniform(low, high):.4g} mm"


def stress(draw: Draw, low: float, high: float) -> str:
    """Between two stresses in MPa."""
    return f"{draw.uniform(low, high):.4g} MPa"
