"""Bars between blocks: their law, their motion, and what they hold."""
