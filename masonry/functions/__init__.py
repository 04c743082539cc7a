"""What commands of the shell do, as functions: `masonry` hands them on."""
