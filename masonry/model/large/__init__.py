"""Models of large displacement, made from those of small ones: bodies, what may meet, the stable step."""
