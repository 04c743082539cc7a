"""Scenes from text, with blocks and tets made in Python where the text says kind = "file"."""

import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from geometry.block_file import save_blocks
from geometry.blocks import Specimen, TetMesh
from masonry import laboratory, scene
from masonry.assembly import Assembly, assemble
from masonry.errors import Stopped
from masonry.results import Result
from masonry.scene import Scene
from verification.closed_forms import Joint


def joint_table(joint: Joint, pair: str = "unit_unit") -> str:
    """The table [contact.PAIR] of a joint, whatever its law."""
    return f"""[contact.{pair}]
normal_stiffness = "{joint.kn / 1e9!r} GPa/m"
shear_stiffness = "{joint.ks / 1e9!r} GPa/m"
tensile_strength = "{joint.fT / 1e6!r} MPa"
cohesion = "{joint.c0 / 1e6!r} MPa"
tan_friction_angle = {joint.tan0!r}
residual_cohesion = "{joint.c_res!r} Pa"
tan_residual_friction_angle = {joint.tan_res!r}
fracture_energy_mode_1 = "{joint.G_I!r} N/m"
fracture_energy_mode_2 = "{joint.G_II!r} N/m"
fracture_energy_mode_2_slope = "{joint.G_II_slope * 1e6!r} N/m/MPa"
exponent_tension = {joint.alpha!r}
exponent_shear = {joint.beta!r}
"""


@contextmanager
def loaded(
    text: str,
    overrides: Mapping[str, Any] | None = None,
    specimen: Specimen | None = None,
    mesh: TetMesh | None = None,
) -> Iterator[Scene]:
    """A scene of TOML text; the text of a made specimen says kind = "file" and path = "made.blocks.h5"."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.toml"
        path.write_text(text, encoding="utf-8")
        if specimen is not None:
            save_blocks(Path(folder) / "made.blocks.h5", specimen, mesh)
        yield scene.load(path, dict(overrides or {}))


def assembled(text: str, specimen: Specimen | None = None, mesh: TetMesh | None = None) -> Assembly:
    """The model of a scene's text."""
    with loaded(text, None, specimen, mesh) as found:
        return assemble(found)


def run(
    text: str,
    overrides: Mapping[str, Any] | None = None,
    specimen: Specimen | None = None,
    mesh: TetMesh | None = None,
) -> Result:
    """Run a scene of TOML text."""
    with loaded(text, overrides, specimen, mesh) as found:
        return laboratory.run(found)


def run_to_the_end_or_the_stop(
    text: str, overrides: Mapping[str, Any] | None = None, specimen: Specimen | None = None
) -> tuple[Result, bool]:
    """The result, and whether the run was stopped: a mechanism turns or leaps out of what can be trusted."""
    try:
        return run(text, overrides, specimen), False
    except Stopped as stop:
        return stop.result, True
