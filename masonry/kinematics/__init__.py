"""How a block moves: rigid (6 dofs), affine (12), tets (3 per node), each once for small displacements and once for
large ones (turning, deforming, deforming_tets). Each file: arrays, `update_positions`, `move`.
"""
