"""Quantities that were booked twice and must agree: energies, forces, what a law dissipates."""
