"""Faces that are flat but for noise: found, and made flat exactly."""
