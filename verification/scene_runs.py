"""A scene is run and judged: how it ended, whether its ledger closes, and what it says of itself."""

import math
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Specimen, TetMesh
from geometry.files.blocks_h5 import save_blocks
from masonry import scene
from masonry.assembly.assemble import Assembly, assemble
from masonry.errors import SceneError, Stopped
from masonry.judgement.judgement import judgement_of
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from masonry.scene import Scene
from verification import balance
from verification.references.closed_forms import Joint

Settings = Mapping[str, Any]
FOLDER = Path(__file__).parent / "scenes"
"""The scenes of the verification, which `masonry run` takes too."""
BLOCKS = "made.blocks.h5"


@dataclass
class SceneRun:
    """Outcome of a scene.

    status     OK, STOPPED (the result is that of the steps before), REFUSED (there is none) or NOT FINITE
    reason     why it is not OK, in the program's own words
    summary, rows  of the result, SI; empty where it was refused
    imbalance  the largest residual of the energy balance over the external work, added up by `balance`
    times      seconds of stepping, of each repeat; the compile is apart
    """

    scene: str
    knobs: dict[str, Any] = field(default_factory=dict)
    status: str = "OK"
    reason: str = ""
    summary: Mapping[str, Any] = field(default_factory=dict)
    rows: dict[str, np.ndarray] = field(default_factory=dict)
    times: list[float] = field(default_factory=list)
    threads: int = 1
    imbalance: float = math.nan
    result: Result | None = None

    @property
    def name(self) -> str:
        """Of the scene, short."""
        return Path(self.scene).stem

    @property
    def ok(self) -> bool:
        return self.status == "OK"

    @property
    def seconds(self) -> float:
        """The least of the repeats: what else the machine did only ever adds."""
        return min(self.times, default=math.nan)

    @property
    def warning(self) -> str:
        """Doubts of the program itself about the result; "" where it says nothing."""
        if not self.summary:
            return "there is no summary"
        return "; ".join(doubt.sentence for doubt in judgement_of(self.summary).doubts)

    def value(self, quantity: str) -> float:
        """Peak and final stress (Pa), or the energy dissipated by fracture and friction (J)."""
        if quantity == "dissipated":
            return balance.dissipated(self.summary)
        return float(self.summary["peak_stress_pa" if quantity == "peak" else "final_stress_pa"])


def judge(result: Result, name: str = "", knobs: Settings | None = None, stopped: str = "") -> SceneRun:
    """The result of a run that came to its end, or was `stopped` for a reason."""
    summary, rows = result.summary, result.history.rows
    status, reason = ("STOPPED", stopped) if stopped else ("OK", "")
    if not (all(np.isfinite(v).all() for v in rows.values()) and _finite(summary)):
        status, reason = "NOT FINITE", stopped or "the results hold NaN or infinity"
    times, gap = [float(summary["seconds_run"])], balance.open_by(result)
    return SceneRun(name, dict(knobs or {}), status, reason, summary, rows, times, imbalance=gap, result=result)


def run(
    name: str,
    knobs: Settings | None = None,
    specimen: Specimen | None = None,
    mesh: TetMesh | None = None,
    threads: int = 1,
) -> SceneRun:
    """Run a scene of this name (see `loaded`); never raises for what the program refuses or stops."""
    try:
        with loaded(name, knobs, specimen, mesh) as scene:
            one = judge(laboratory.run(scene, threads), name, knobs)
    except (SceneError, GeometryError) as refused:
        one = SceneRun(name, dict(knobs or {}), "REFUSED", str(refused))
    except Stopped as stopped:
        one = judge(stopped.result, name, knobs, str(stopped))
    one.threads = threads
    return one


def result_of(name: str, knobs: Settings | None = None) -> Result:
    """The result of a scene that must come to its end. Raises what the program refuses or stops."""
    with loaded(name, knobs) as scene:
        return laboratory.run(scene)


def assembled(
    name: str, knobs: Settings | None = None, specimen: Specimen | None = None, mesh: TetMesh | None = None
) -> Assembly:
    """The model of a scene."""
    with loaded(name, knobs, specimen, mesh) as scene:
        return assemble(scene)


def source_of(name: str) -> str:
    """Argument of `scene.load`: the file of a scene of the verification, or what is none, a packaged name or a path."""
    file = FOLDER / f"{name}.toml"
    return str(file) if file.is_file() else name


def text_of(name: str) -> str:
    """The file of a scene; a text stays as it is."""
    if "\n" in name:
        return name
    packaged = scene.packaged()
    file = packaged[name] if name in packaged else FOLDER / f"{name}.toml"
    return file.read_text(encoding="utf-8")


def load(name: str, knobs: Settings | None = None) -> Scene:
    """A scene that brings its own specimen. Raises SceneError."""
    return scene.load(source_of(name), knobs or {})


def joint_of(name: str, knobs: Settings) -> Joint:
    """The joint of a scene in the paper's letters; 0 for what its law does not need."""
    contact = load(name, knobs).contact["unit_unit"]
    return Joint(
        kn=contact.normal_stiffness,
        ks=contact.shear_stiffness,
        fT=contact.tensile_strength or 0.0,
        c0=contact.cohesion or 0.0,
        tan0=contact.tan_friction or 0.0,
        c_res=contact.residual_cohesion or 0.0,
        tan_res=contact.tan_residual_friction or 0.0,
        G_I=contact.fracture_energy_mode_1 or 0.0,
        G_II=contact.fracture_energy_mode_2 or 0.0,
        G_II_slope=contact.fracture_energy_mode_2_slope or 0.0,
        alpha=contact.exponent_tension or 0.0,
        beta=contact.exponent_shear or 0.0,
    )


@contextmanager
def loaded(
    name: str, knobs: Settings | None = None, specimen: Specimen | None = None, mesh: TetMesh | None = None
) -> Iterator[Scene]:
    """A scene of the verification or a packaged one with some keys set anew, by dotted key. Raises SceneError.

    specimen, mesh  blocks and tets made in Python, in place of the scene's own
    """
    keys = dict(knobs or {})
    with tempfile.TemporaryDirectory() as folder:
        if specimen is not None:
            save_blocks(Path(folder) / BLOCKS, specimen, mesh)
            keys["specimen"] = {"kind": "file", "path": str(Path(folder) / BLOCKS)}
        yield scene.load(source_of(name), keys)


def _finite(value: Any) -> bool:
    if isinstance(value, Mapping):
        return all(map(_finite, value.values()))
    return not isinstance(value, float) or math.isfinite(value)
