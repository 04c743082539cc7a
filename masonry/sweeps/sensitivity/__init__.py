"""`masonry sensitivity`: one scene run in several ways that should not matter, side by side."""
