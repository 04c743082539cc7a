"""Bars as arrays: where their ends are, what a step takes of them, and how they bound the time step."""
