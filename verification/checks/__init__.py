"""Checks of two runs or of a whole run, for cases: invariance, ledgers, paired runs."""
