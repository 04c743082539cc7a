"""Which sources a result came from: their hash, found without importing anything heavy."""

import fnmatch
import hashlib
import re
import sys
from functools import cache
from pathlib import Path

from masonry.errors import SceneError

ALL = ("geometry", "masonry")
COMPILED = (
    *("masonry/simd", "masonry/jit", "masonry/detection"),
    *("masonry/laws", "masonry/kinematics", "masonry/patches", "masonry/kernels"),
)


@cache
def source_hash(folders: tuple[str, ...] = ALL, without: tuple[str, ...] = ()) -> str:
    """Hash (hex) of the sources in some folders; by default all that can change a number in a result.

    without  patterns of paths that are left out, such as "masonry/curves/curve.py" or "masonry/sweeps/*"
    """
    root = Path(__file__).resolve().parents[2]
    left_out = re.compile("|".join(map(fnmatch.translate, without)) or "(?!)")
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted((root / folder).rglob("*.py")):
            name = path.relative_to(root).as_posix()
            if not left_out.match(name):
                digest.update(name.encode())
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def is_ours(module: str) -> bool:
    """Whether a module's sources are among those that `source_hash` knows."""
    return module.partition(".")[0] in ALL


@cache
def package_hash(part: type | object) -> str:
    """Hash (hex) of the sources of the package, or of the single file, in which a class or function was defined.

    Taken once, so it is of the sources that were imported. Raises SceneError where there are none.
    """
    module = str(part.__module__)
    top = sys.modules.get(module.partition(".")[0])
    file = getattr(top, "__file__", None) or getattr(sys.modules[module], "__file__", None)
    if file is None or not Path(file).is_file():
        raise SceneError(f"the package of {module} has no source file, so nothing tells when it changes")
    place = Path(file).resolve()
    whole = place.name == "__init__.py" or top is None or getattr(top, "__file__", None) is None
    digest = hashlib.sha256(module.encode())
    for path in sorted(place.parent.rglob("*.py")) if whole else [place]:
        digest.update(path.relative_to(place.parent).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
