"""Tables of a scene for motion in real time: the ground that shakes it."""
