"""What is observed between chunks of steps: energy, stability, overlap, slip, sudden cracks."""
