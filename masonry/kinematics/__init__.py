"""How a block moves: rigid (6 freedoms), affine (12), tets (3 per node), each once for small displacements and once for
large ones (turning, deforming, deforming_tets). Each file: arrays, `place`, `move`.
"""
