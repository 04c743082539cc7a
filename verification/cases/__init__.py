"""The catalogue: one case a file; its docstring holds the formula, `CASE` the case."""
