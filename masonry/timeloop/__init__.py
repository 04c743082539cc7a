"""The loop over the steps of a run: its rows, its checkpoints, bonds that retire."""
