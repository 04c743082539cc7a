"""What a script may do with masonry, as a type checker sees it: mypy reads this with the program itself."""

from pathlib import Path
from typing import assert_type

from matplotlib.figure import Figure

import masonry
from masonry.laboratory.result import Result
from masonry.limit_analysis.limit_result import LimitResult
from masonry.results.data import Peak
from masonry.scene import Scene
from masonry.sweeps.sweep_run import SweepResult

BLOCK = """o block
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1
f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4
"""


def use(folder: Path) -> float:
    """Load, change, look, run, read and draw."""
    scene = masonry.load("couplet", {"law": "linear"})
    assert_type(scene, Scene)
    assert_type(scene.with_({"solver.rows": 40}, confinement="0.1 MPa"), Scene)
    assert_type(masonry.scenes(), dict[str, str])
    blocks: int = masonry.check(scene)["blocks"] + masonry.check("couplet")["blocks"]
    result = masonry.run(scene, progress=lambda step, steps, note: None)
    assert_type(result, Result)
    assert_type(result.peak, Peak)
    assert_type(result.energies, dict[str, float])
    assert_type(result.summary.energy_imbalance, float | None)
    assert_type(masonry.check(scene).steps, int)
    assert_type(result.plot(folder / "curve.png"), Figure)
    assert_type(result.save(folder), dict[str, Path])
    assert_type(masonry.limit("arch-tilted", dilation=False), LimitResult)
    pressures = masonry.sweep(scene, {"confinement": ["0.1 MPa", "0.2 MPa"]}, folder / "sweep", workers=0)
    assert_type(pressures, SweepResult)
    assert_type(pressures.result(0), Result)
    assert_type(masonry.load({"base": "couplet"}), Scene)
    (folder / "block.obj").write_text(BLOCK)
    assert_type(masonry.import_blocks(folder / "block.obj").scene, Scene)
    assert_type(masonry.export(scene, folder / "couplet.step"), Path)
    assert_type(masonry.resume(folder), Result)
    again = masonry.load_result(folder)
    return blocks * float(again.curve["stress"][0]) + again.peak.stress
