"""What frames and rows of a run make doubtful, beyond the numbers of its summary: a file each."""
