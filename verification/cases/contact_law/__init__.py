"""One contact along a path: each law in tension, shear and mixed mode."""
