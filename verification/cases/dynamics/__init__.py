"""Time steps, frequencies, impacts and waves."""
