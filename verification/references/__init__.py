"""References that do not use the program: closed forms and the interface model."""
