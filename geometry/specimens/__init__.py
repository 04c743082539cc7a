"""Specimens that the program builds: couplet, prism, wallette, walls, bending."""
