"""Whole specimens: energy balances, and the experiments of the paper."""
