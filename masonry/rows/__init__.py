"""The rows of a curve: columns, frames, peak, cycles; whether what a row shows is at rest."""
