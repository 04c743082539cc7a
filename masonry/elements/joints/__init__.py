"""Joints, as far as they answer for themselves: how they crush."""
