"""How the load advances from chunk to chunk: at a fixed rate, or paced by its error."""
