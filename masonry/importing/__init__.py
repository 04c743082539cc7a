"""From a file of solids or of a mesh to blocks and a scene."""
