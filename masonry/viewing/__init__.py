"""The model of a scene, or a result, in space: one page of HTML that needs nothing beside it."""
