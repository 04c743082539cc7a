"""Motions of the ground as plain arrays: records, what they do to oscillators, motions by seed. Knows no model."""
