"""Bars beside numbers: of a run, of a sweep, and the line of `masonry check` that names the command."""
