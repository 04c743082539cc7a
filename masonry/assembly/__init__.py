"""From a scene to a model: specimen, joints, mesh, laws, conditions, schedule of the loading."""
