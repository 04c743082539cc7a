"""Strength of joints by their contact points, beside that of stresses spread over their areas."""
