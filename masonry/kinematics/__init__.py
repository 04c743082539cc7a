"""How a block moves: rigid (6 freedoms), affine (12), tets (3 per node). Each file: arrays, `place`, `move`."""
