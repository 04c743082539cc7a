"""Error bars of `masonry converge` beside what brute force says."""
