"""Kinds of bad input, one a file."""
