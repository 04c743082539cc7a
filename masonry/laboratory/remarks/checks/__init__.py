"""What `masonry check` alone says of a scene: no doubts of a run, which sees for itself."""
