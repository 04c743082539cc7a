"""Bridges under loads that travel."""
