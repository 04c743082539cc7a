"""One file for each command of the shell: its words, and what it calls."""
