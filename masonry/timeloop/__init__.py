"""The loop over the steps of a run: its recording, its checkpoints, its reactions."""
