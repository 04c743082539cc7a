"""What joints bear by their contact points, beside what stresses spread over their areas bear."""
