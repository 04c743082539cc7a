"""Crushing: the cap and the cut-off, joints whose toe crushes, and the interface model beside them."""
