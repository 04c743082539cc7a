"""What is drawn over the blocks of a specimen."""
