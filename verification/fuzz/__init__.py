"""`python -m verification.fuzz`: bad input on purpose, for every file and every word that a command reads."""
