"""Which sources a result came from: their hash, found without importing anything heavy."""

import hashlib
from functools import cache
from pathlib import Path

ALL = ("geometry", "masonry")
COMPILED = ("masonry/laws", "masonry/kernels", "masonry/kinematics")


@cache
def source_hash(folders: tuple[str, ...] = ALL, without: tuple[str, ...] = ()) -> str:
    """Hash (hex) of the sources in some folders; by default all that can change a number in a result.

    without  patterns of paths that are left out, such as "masonry/plot.py" or "masonry/sweep/*"
    """
    root = Path(__file__).resolve().parents[2]
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted((root / folder).rglob("*.py")):
            name = path.relative_to(root)
            if not any(name.match(pattern) for pattern in without):
                digest.update(name.as_posix().encode())
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
