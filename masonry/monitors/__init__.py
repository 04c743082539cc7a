"""Observers between chunks of steps: stability, overlap, slip, sudden cracks."""
