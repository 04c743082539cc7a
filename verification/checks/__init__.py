"""What cases hold two runs or a whole run against: invariance, ledgers, paired runs."""
