"""Test rigs of the cases: one contact, a few blocks, a wave, an arch; what sets them up, runs them and measures."""
