"""The command `masonry`."""
