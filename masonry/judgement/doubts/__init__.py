"""One file a doubt, or a pair of them: what it asks, why its limit is what it is, and what is said beyond it."""
