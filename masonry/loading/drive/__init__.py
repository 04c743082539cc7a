"""A drive that is paced by its error."""
