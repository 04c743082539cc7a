"""`python -m masonry` is the command `masonry`."""

import sys

from masonry.cli.main import main

sys.exit(main())
