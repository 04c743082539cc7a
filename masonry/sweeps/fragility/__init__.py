"""From the table of a sweep to a fragility curve: what falls at which intensity of the ground's motion."""
