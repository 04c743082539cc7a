"""The tables of a scene file: what each may hold, checked and turned into SI units."""
