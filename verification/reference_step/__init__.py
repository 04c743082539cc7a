"""The step once more, written by hand for one case: what the same work costs where nothing is general about it."""
