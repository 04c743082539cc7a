"""What is observed between chunks of steps: stability, overlap, slip, sudden cracks."""
