"""A load that grows until nothing balances it, and the branch behind the collapse."""
