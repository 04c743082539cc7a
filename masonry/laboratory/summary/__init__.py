"""The numbers of summary.json, a part a file, from an assembly and the outcome of its run."""
