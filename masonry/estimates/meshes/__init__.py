"""What tets of constant strain store too much, and how much too heavy they turn."""
