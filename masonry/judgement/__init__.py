"""How far to trust the numbers of a run, from the numbers themselves."""
