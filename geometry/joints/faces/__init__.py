"""Joint faces as wholes, of one convex polygon or several: their points, middles and second moments, strips across."""
