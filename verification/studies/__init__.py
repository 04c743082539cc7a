"""Studies: each module with a `chapter` runs scenes, compares them with a reference, and writes a chapter."""
