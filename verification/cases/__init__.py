"""The cases: one a file, whose docstring holds the formula, as CASE or CASES (see `verification/catalogue.py`)."""
