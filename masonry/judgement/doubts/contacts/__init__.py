"""Events that contacts of the shape as drawn do not describe: overlaps, long slips, blocks that meet."""
