"""Loops only: contacts, motion, and `step.py`, Fig. 2 of the paper on one screen."""
