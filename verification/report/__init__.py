"""The verification report: one HTML file that stands alone, and its numbers as JSON."""
