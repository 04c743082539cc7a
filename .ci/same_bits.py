"""Two checkouts, one answer: runs packaged scenes in both, and compares curves, summaries and crack arrays bit by bit.

    .venv/bin/python .ci/same_bits.py OLD NEW [SCENE ...]

Both run with the packages of this interpreter. Exit code 1 where anything differs but seconds, versions and hashes.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

PASSING = {"version", "source_hash"}


def run(checkout: Path, scene: str, out: Path) -> None:
    """Run a scene with the sources of a checkout."""
    command = [sys.executable, "-m", "masonry", "run", scene, "--out", str(out), "--quiet"]
    subprocess.run(command, cwd=checkout, env={**os.environ, "PYTHONPATH": str(checkout)}, check=False)


def passes(key: str) -> bool:
    """Whether what has this key says when or by which version a run was made, and not what came out."""
    return key in PASSING or key.startswith("seconds")


def stripped(value: object) -> object:
    """A summary without what passes: seconds, versions and hashes; nor what was not measured, written or not."""
    if isinstance(value, dict):
        return {key: stripped(below) for key, below in value.items() if not passes(key) and below is not None}
    return [stripped(below) for below in value] if isinstance(value, list) else value


def arrays(file: Path) -> dict[str, bytes]:
    """The bytes of every array of history.h5, by its path."""
    found: dict[str, bytes] = {}

    def take(name: str, item: h5py.Group | h5py.Dataset) -> None:
        if isinstance(item, h5py.Dataset):
            value = np.asarray(item[()])
            found[name] = repr(value.tolist()).encode() if value.dtype == object else value.tobytes()

    with h5py.File(file) as root:
        root.visititems(take)
    return found


def differences(old: Path, new: Path) -> list[str]:
    """The names of what is not the same in two folders of results; none where neither is there, as both are refused."""
    made = [(folder / "summary.json").is_file() for folder in (old, new)]
    if not all(made):
        return ["one of them left no results"] if any(made) else []
    names = [name for name in ("curve.csv", "scene.toml") if (old / name).read_bytes() != (new / name).read_bytes()]
    summaries = [stripped(json.loads((folder / "summary.json").read_text())) for folder in (old, new)]
    if summaries[0] != summaries[1]:
        keys = {key for key in (*summaries[0], *summaries[1]) if summaries[0].get(key) != summaries[1].get(key)}
        names.append(f"summary.json ({', '.join(sorted(keys))})")
    first, second = (arrays(folder / "history.h5") for folder in (old, new))
    return names + [name for name in sorted({*first, *second}) if first.get(name) != second.get(name)]


def main() -> int:
    """Compare; the exit code."""
    old, new, scenes = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3:]
    bad = 0
    for scene in scenes or sorted(file.stem for file in (old / "masonry" / "scenes").glob("*.toml")):
        with tempfile.TemporaryDirectory() as folder:
            outs = [Path(folder) / name for name in ("old", "new")]
            for checkout, out in zip((old, new), outs, strict=True):
                run(checkout, scene, out)
            differ = differences(*outs)
        bad += bool(differ)
        print(f"{scene:<28} {'the same' if not differ else 'DIFFERENT: ' + ', '.join(differ)}", flush=True)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
