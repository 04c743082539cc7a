"""A run on one page that a client can be given: `masonry report`."""
