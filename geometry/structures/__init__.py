"""Structures that people build, stone by stone: walls with openings, arches, vaults, domes, columns."""
