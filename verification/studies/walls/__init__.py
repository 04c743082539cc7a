"""Walls that were measured beside walls that are computed; as a part of the report it is called `walls`."""

from verification.studies.walls.measured_walls import ORDER, chapter

__all__ = ["ORDER", "chapter"]
