"""Stability: grids of knobs that go to their limits; each cell ends in a right answer or in a reason."""
