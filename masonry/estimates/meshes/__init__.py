"""Energy that tets of constant strain store too much, and inertia of masses at their corners."""
