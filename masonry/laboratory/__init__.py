"""Run a scene, or look at it first, and say in words what came of it."""
