"""What becomes of a run whose process is killed, told to end, or cannot write."""
