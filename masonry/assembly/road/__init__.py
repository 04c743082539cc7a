"""Loads on a structure: earth up to a level, and a vehicle on the road above it."""
