"""Sizes of blocks: many divisions of one wallette into cells, and what sizes and seeds do to it."""
