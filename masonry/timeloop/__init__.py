"""The loop over the steps of a run: its rows and checkpoints."""
