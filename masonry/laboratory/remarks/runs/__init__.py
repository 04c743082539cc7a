"""Doubts from frames and rows of a run, beyond the numbers of its summary: a file each."""
