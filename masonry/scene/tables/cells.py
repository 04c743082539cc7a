"""Division of a specimen into cells in a scene: their number or size, relative sizes, seeds."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal

from pydantic import Field, StrictBool, model_validator

from geometry.cells.request import CellRequest
from masonry.scene.tables.types import CellCount, KeyedError, Length, Number, Position, RelativeSize, Spread, Table

AMOUNTS = ("total", "per_unit", "size")


class CellsTable(Table):
    """Cells in place of a regular grid; exactly one of total, per_unit and size says how many.

    form  "plane": of the plane x-z, each as deep as the unit; "space": in all three dimensions
    """

    total: CellCount | None = None
    per_unit: CellCount | None = None
    size: Length | None = None
    kind: Literal["laguerre", "voronoi"] = "laguerre"
    form: Literal["plane", "space"] = "plane"
    spread: Spread = 0.0
    sizes: Annotated[tuple[RelativeSize, ...], Field(min_length=1)] | None = None
    sites: Annotated[tuple[tuple[Position, Position, Position], ...], Field(min_length=1)] | None = None
    seed: Number = 0
    regularise: StrictBool = True

    @property
    def request(self) -> CellRequest:
        """The request for the division."""
        plain = ("total", "per_unit", "size", "spread", "sizes", "sites", "seed", "regularise")
        sizes = {key: getattr(self, key) for key in plain}
        return CellRequest(**sizes, space=self.form == "space", laguerre=self.kind == "laguerre")

    @model_validator(mode="after")
    def _fits_together(self) -> "CellsTable":
        amounts = [name for name in AMOUNTS if getattr(self, name) is not None]
        if len(amounts) != 1:
            raise KeyedError(
                amounts[1] if amounts else "total",
                f"exactly one of {', '.join(AMOUNTS)} says how many cells, not {' and '.join(amounts) or 'none'}",
            )
        if self.kind == "voronoi" and (self.sizes is not None or self.spread > 0):
            key = "spread" if self.sizes is None else "sizes"
            raise KeyedError(key, "the sizes of Voronoi cells cannot be given; kind = 'laguerre' takes sizes")
        if self.sizes is not None and self.spread > 0:
            raise KeyedError("spread", "spread and sizes both say how large cells are; keep one of them")
        if self.sizes is not None and self.per_unit is not None and len(self.sizes) != self.per_unit:
            raise KeyedError("sizes", f"there are {len(self.sizes)} sizes for {self.per_unit} cells per unit")
        if self.sites is not None and len(self.sites) != self.total:
            raise KeyedError("sites", f"there are {len(self.sites)} sites; write total = {len(self.sites)}")
        return self


def exclude(table: Any) -> None:
    """A part of a specimen is divided into a grid or into cells, not into both."""
    if table.cells is not None and any(n > 1 for n in table.divisions):
        raise KeyedError("cells", "divisions and cells exclude each other; leave divisions out")


def filling_of(table: Any) -> Sequence[int] | CellRequest:
    """Blocks along each axis, or the cells that a table asks for."""
    divisions: Sequence[int] = table.divisions
    return divisions if table.cells is None else table.cells.request
