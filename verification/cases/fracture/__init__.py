"""Cracks: couplets, beams and wallettes against closed forms and the interface model."""
