"""The wallettes in tension: what is read off their cracks and curves, and the claims on them."""
