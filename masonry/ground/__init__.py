"""Motion of the ground: records, their spectra, records made by seed. Plain arrays; knows no model."""
