"""How a load advances: chunk by chunk."""
