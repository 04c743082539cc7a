"""Tables of specimens: what all of them have, and the structures that people build."""
