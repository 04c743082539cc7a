"""Doubts about a scene before it runs: a file each, which `masonry check` and a run both ask."""
