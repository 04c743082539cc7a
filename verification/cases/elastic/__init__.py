"""Elastic states: patches, bending, reactions, and what is reported of them."""
