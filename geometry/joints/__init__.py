"""Where blocks touch: joints, contact points, their areas and quality."""
