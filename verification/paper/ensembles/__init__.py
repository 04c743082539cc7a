"""Walls whose properties scatter: many drawn alike, their curves, cracks and claims."""
