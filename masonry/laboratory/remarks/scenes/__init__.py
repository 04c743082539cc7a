"""What a scene makes doubtful before it runs: a file each, which `masonry check` and a run both ask."""
