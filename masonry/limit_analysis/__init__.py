"""Limit analysis of a scene: its contacts and loads, the factor, how it fails, in words and pictures."""
