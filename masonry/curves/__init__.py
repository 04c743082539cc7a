"""Curves of a run as pictures: stress against displacement, loops, settling, the energy ledger."""
