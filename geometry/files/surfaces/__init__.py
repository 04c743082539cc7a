"""Closed surfaces from files (OBJ, PLY, STL) as blocks, and blocks as such files."""
