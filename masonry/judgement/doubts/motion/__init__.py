"""What moves though it should rest or follow its drive, and what damping does to it."""
