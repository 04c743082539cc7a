"""Sliding, rocking and standing: blocks without strength."""
