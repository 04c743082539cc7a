"""`python -m masonry` is the command `masonry`."""

import sys

from masonry.cli import main

sys.exit(main())
