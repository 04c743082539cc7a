"""What a scene says of motion in real time: the ground that shakes it."""
