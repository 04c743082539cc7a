"""Finite elements with joints of no thickness between them: a model of masonry that shares nothing with the solver.

Tier 1: linear tets and joints lumped at the vertices of facets, on the very mesh of a run: the same discretisation as
point contacts at nodes, solved implicitly. Tier 2: quadratic tets and Gauss points, refined: the truth, with an order.
"""
