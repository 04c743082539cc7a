"""How far bodies have moved, steadily or not; how what drifts is told from what swings."""
