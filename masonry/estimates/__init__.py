"""Estimates of the deficits of contact points, sections and joints: numbers, which remarks set against their limits."""
