"""Bars between points of blocks: before a model is made, in it, and how they bound the time step."""
