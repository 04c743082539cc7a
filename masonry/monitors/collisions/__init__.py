"""Blocks without a joint that meet in small displacement."""
