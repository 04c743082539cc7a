"""How far bodies have moved, steadily or not; impulses that brake them."""
