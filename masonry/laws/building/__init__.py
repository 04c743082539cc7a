"""From the numbers of a scene to a law, of ours or of another package."""
