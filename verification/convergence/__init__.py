"""Problems on which error is set against run time: one a file, as PROBLEMS; found without a list."""
