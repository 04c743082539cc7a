"""Cases of blocks that turn, slide and fall as far as they like."""
