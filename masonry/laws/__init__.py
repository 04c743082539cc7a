"""Contact laws: equations only, one law a file; `door.py` lets them into the step, `build.py` checks their numbers.

Laws of other packages come in by `outside.py`.
"""

from functools import cache
from pathlib import Path


@cache
def law_names() -> tuple[str, ...]:
    """Every law of ours: a file of this folder that names its PARAMETERS. Reads the folder, imports nothing."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    return tuple(file.stem for file in files if "\nPARAMETERS" in file.read_text(encoding="utf-8"))
