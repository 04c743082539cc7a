"""Table of a scene for masses that are added to its blocks: floors, roofs, bells, what stands on a shaking table."""

from typing import Annotated

from masonry.scene.tables.gravity_and_floor import Coordinate
from masonry.scene.tables.types import Given, Selector, Table


class AddedMass(Table):
    """A mass (kg) shared by whole blocks in proportion to their volumes, or borne by the one of them that holds a
    place `at` (m): its weight, and its inertia against all motion."""

    on: Selector
    mass: Annotated[float, Given("mass", "(0, 1e12]")]
    at: tuple[Coordinate, Coordinate, Coordinate] | None = None
