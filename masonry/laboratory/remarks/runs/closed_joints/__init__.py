"""Doubts about joints that stay closed: three ways in which their contact points may decide the answer."""
