"""What a run leaves behind, as data and as files."""
