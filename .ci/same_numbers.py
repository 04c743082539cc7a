"""Several processors, one answer: runs packaged scenes as they would be compiled for others, and compares the numbers.

    .venv/bin/python .ci/same_numbers.py [--targets own haswell generic plain] [--out FOLDER] [SCENE ...]

Processors differ in what they round: whether a product is added in one operation, and how many numbers are summed at
once. That moves the last digit of each number, and no more, unless a run decides by it: which of two joints that are
alike opens. Numbers may differ by the accuracy that the scene asks for, or `PLAIN` without one. A run that differs by
more must have told so: by the symmetry that its cracks lost, by its sudden cracks, or by another doubt.
Exit code 1 where one differs by more and none of its runs told so.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

TARGETS = {
    "own": {},
    "haswell": {"NUMBA_CPU_NAME": "haswell", "NUMBA_CPU_FEATURES": ""},  # without features those of this machine stay
    "generic": {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""},
    "plain": {"MASONRY_LANES": "0"},
}
"""What sets a processor: its own; AVX2 in place of AVX-512; SSE2, which cannot add a product in one operation; and one
number at a time."""
PLAIN = 1e-3
"""Accuracy of a run whose steps are given: what dead loads dissipate while they settle hangs on how they vibrate."""
FRACTURE = ("fracture_mode_1", "fracture_mode_2", "friction")
FALLING = ("final", "work", "dissipated", "broken area")
"""What hangs on how a specimen falls, and on nothing before."""
Summary = dict[str, Any]


def run(scene: str, target: str, out: Path) -> Summary:
    """The summary of a scene; what a run says that ends without one."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith("NUMBA_CPU")}
    environment.pop("MASONRY_LANES", None)
    command = [sys.executable, "-m", "masonry", "run", scene, "--out", str(out), "--quiet"]
    done = subprocess.run(command, env=environment | TARGETS[target], capture_output=True, text=True, check=False)
    file = out / "summary.json"
    if not file.exists():
        return {"failed": (done.stderr or done.stdout).strip()}
    summary: Summary = json.loads(file.read_text(encoding="utf-8"))
    return summary


def numbers(summary: Summary) -> dict[str, tuple[float, float]]:
    """What is compared, by name: the number, and the size against which a difference counts."""
    energy = summary["energy_j"]
    work = max(abs(energy["external_work"]), summary.get("work_of_force_j") or 0.0)
    peak, lowest, final = (summary[f"{key}_stress_pa"] or 0.0 for key in ("peak", "lowest", "final"))
    stress = max(abs(peak), abs(lowest))  # nothing without a drive
    found = {
        "peak": (peak, stress),
        "final": (final, stress),
        "work": (energy["external_work"], work),
        "dissipated": (sum(energy[key] for key in FRACTURE), work),
        "broken area": (sum(summary["broken_area_m2"].values()), sum(summary["damaged_area_m2"].values())),
    }
    if (load := summary.get("collapse_load")) is not None:
        found["factor"] = (load["borne"], load["borne"])
    if (fell := summary.get("collapse")) is not None:
        found["time of the fall"] = (fell["time_s"], fell["time_s"])
    if fell is not None or (load is not None and load["falls"] is not None):
        found = {key: value for key, value in found.items() if key not in FALLING}
    return found


def accuracy(summary: Summary) -> float:
    """The accuracy that the scene asks for."""
    return float((summary.get("collapse_load") or summary["control"]).get("accuracy") or PLAIN)


def tells(summary: Summary) -> str:
    """Why another run of the same may differ, in the run's own words; "" where it says nothing."""
    if summary["symmetry_lost"]:
        return f"symmetry lost across {summary['symmetry_lost']}"
    if summary.get("sudden_cracks") and summary["verdict"] != "sound":
        return "sudden cracks"
    return "" if summary["verdict"] == "sound" else str(summary["verdict"])


def compared(one: Summary, other: Summary) -> tuple[str, float]:
    """The number that differs most, and by how much."""
    first, second = numbers(one), numbers(other)
    if first.keys() != second.keys():
        return ", ".join(sorted(first.keys() ^ second.keys())), math.inf
    apart = {name: abs(value - second[name][0]) / size if size > 0.0 else 0.0 for name, (value, size) in first.items()}
    most = max(apart, key=lambda name: apart[name])
    return most, apart[most]


def judged(summaries: dict[str, Summary]) -> tuple[str, bool]:
    """What is said of one scene: the difference of each target from the first, and whether all is well."""
    failed = [f"{target}: {summary['failed'][-200:]}" for target, summary in summaries.items() if "failed" in summary]
    if failed:
        return "FAILED " + "; ".join(failed), False
    (_, one), *others = summaries.items()
    words, worst = [], 0.0
    for target, summary in others:
        name, apart = compared(one, summary)
        words.append(f"{target} {apart:.1e} ({name})")
        worst = max(worst, apart)
    asked = accuracy(one)
    if worst <= asked:
        return f"the same within {asked:.0e}: {', '.join(words)}", True
    remarks = list(dict.fromkeys(said for summary in summaries.values() if (said := tells(summary))))
    verdict = f"told: {', '.join(remarks)}" if remarks else "DIFFERENT, and not told"
    return f"{verdict}: {', '.join(words)}", bool(remarks)


def main() -> int:
    """Compare; the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--targets", nargs="+", choices=TARGETS, default=list(TARGETS))
    parser.add_argument("--out", type=Path, help="folder in which the results are left; what is there is not run again")
    asked = parser.parse_args()
    from masonry.scene import packaged

    bad = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = asked.out or Path(temporary)
        for scene in asked.scenes or sorted(packaged()):
            summaries = {}
            for target in asked.targets:
                place, kept = folder / target / scene, folder / f"{scene}-{target}.json"
                if not kept.exists():
                    kept.parent.mkdir(parents=True, exist_ok=True)
                    kept.write_text(json.dumps(run(scene, target, place)), encoding="utf-8")
                summaries[target] = json.loads(kept.read_text(encoding="utf-8"))
            words, well = judged(summaries)
            bad += not well
            print(f"{scene:<28} {words}", flush=True)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
