"""Scenes, results, checkpoints, sweeps and words on the command line."""
