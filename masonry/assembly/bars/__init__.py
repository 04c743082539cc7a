"""From a scene's bars to the blocks that hold their ends."""
