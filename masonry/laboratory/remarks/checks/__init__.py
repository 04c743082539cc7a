"""Remarks of `masonry check` alone on a scene: no doubts of a run, which sees for itself."""
