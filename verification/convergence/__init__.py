"""Problems on which error is set against run time, as PROBLEMS of each file; found without a list."""
