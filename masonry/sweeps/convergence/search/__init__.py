"""Settings of a scene by which its errors are as small as asked for."""
