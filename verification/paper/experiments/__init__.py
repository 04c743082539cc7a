"""One experiment of the paper a file, each with an EXPERIMENT; no list names them."""
