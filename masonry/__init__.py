"""Masonry on the computer: discrete elements with elastic-softening contacts, tested and told how far to trust."""

__version__ = "0.1.0"
