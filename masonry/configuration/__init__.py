"""How blocks and contacts move and what they hold, in small displacement and in large: steps, energies, state."""
