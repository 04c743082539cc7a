"""The specimen of a scene with its supports and loads as a picture, and the picture of a law."""
