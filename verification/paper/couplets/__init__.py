"""What the couplets of section 4 show: measures of their curves, and the claims held against them."""
