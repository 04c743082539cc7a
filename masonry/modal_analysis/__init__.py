"""Modes of a scene: frequencies, shapes and effective masses, from the tangent stiffness of joints and blocks.

The eigenvalue problem itself is eigen.py, by a block Krylov method.
"""
