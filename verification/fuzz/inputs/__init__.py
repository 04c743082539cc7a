"""Where inputs for fuzzing come from: valid seeds, and ways to spoil them."""
