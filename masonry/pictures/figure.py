"""A figure of matplotlib that a notebook shows by itself, once, with no help from pyplot and no display."""

from io import BytesIO

from matplotlib.figure import Figure

DPI = 107


class ShownFigure(Figure):
    """The last value of a cell: its picture stands below. Otherwise as any figure: `axes`, `savefig`, ..."""

    def _repr_png_(self) -> bytes:
        content = BytesIO()
        self.savefig(content, format="png", dpi=DPI)
        return content.getvalue()
