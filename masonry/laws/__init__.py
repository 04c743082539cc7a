"""Contact laws: equations only, one law a file; `door.py` lets them into the step, `build.py` checks their numbers."""

from pathlib import Path


def law_names() -> tuple[str, ...]:
    """Every law: a file of this folder that names its PARAMETERS. Reads the folder, imports nothing."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    return tuple(file.stem for file in files if "\nPARAMETERS" in file.read_text(encoding="utf-8"))
