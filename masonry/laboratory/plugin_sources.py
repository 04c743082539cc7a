"""Which sources of other packages a result came from, besides ours: those of its laws and of its specimen."""

import hashlib
from collections.abc import Iterable

from masonry.jit.sources import package_hash
from masonry.laws import law_names
from masonry.laws.plugins import outside_law
from masonry.scene.tables.specimen import kinds
from masonry.scene.tables.specimen_plugins import own_specimen


def own_sources(laws: Iterable[str | None], kind: str) -> str:
    """Hash (hex) of the packages that bring some laws (None is none) and a kind of specimen; "" where all are ours."""
    found = [outside_law(law) for law in sorted({law for law in laws if law is not None and law not in law_names()})]
    hashes = [package_hash(law.shape) for law in found if law is not None]
    if kind not in kinds() and (specimen := own_specimen(kind)) is not None:
        hashes.append(package_hash(specimen.function))
    return hashlib.sha256(" ".join(hashes).encode()).hexdigest()[:16] if hashes else ""
