"""First scenes by task: a commented file with the numbers of the user, and stated assumptions for all others."""
