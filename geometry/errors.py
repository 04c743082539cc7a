"""The error of geometry, which needs no arrays: whoever catches it need not load them."""


class GeometryError(ValueError):
    """A specimen that cannot be built; the message says what, where and what would work."""
