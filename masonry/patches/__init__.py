"""Patches: what blocks meet, and where; contacts that press and rub, found and found again as blocks move."""
