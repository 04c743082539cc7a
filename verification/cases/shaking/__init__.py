"""Ground that moves: blocks that slide, lift off and overturn, in closed form or integrated on their own."""
