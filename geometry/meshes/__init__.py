"""Tets inside blocks, and contact points on their nodes."""
