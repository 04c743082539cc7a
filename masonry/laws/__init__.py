"""Contact laws: equations only, one law a file; `door.py` lets them into the compiled step, `build.py` checks their numbers."""
