"""Results of the couplets of section 4: measures of their curves, and the claims held against them."""
