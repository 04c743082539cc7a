"""The benchmarks, which nobody runs every day, can at least be run."""

import subprocess
import sys
from pathlib import Path


def test_all_benchmarks_can_be_collected():
    command = [sys.executable, "-m", "pytest", "benchmarks", "-m", "", "--collect-only", "-p", "no:cacheprovider"]
    root = Path(__file__).resolve().parents[1]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
