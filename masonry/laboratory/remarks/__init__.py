"""What a user should know of a scene and of what moved in it, before and after the run."""
