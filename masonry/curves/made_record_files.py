"""Records of the ground made by seed, and written as CSV."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.errors import SceneError
from masonry.runtime.named_file import require_free

if TYPE_CHECKING:
    from masonry.ground.made_record import MadeRecord


def require_csv(path: Path, overwrite: bool) -> None:
    """Raise SceneError where no record may be written to a file."""
    if path.suffix != ".csv":
        raise SceneError(f"'{path}': the record is a .csv file; nearest: '{path.stem or 'record'}.csv'")
    require_free(path, overwrite)


def made_records(keys: Mapping[str, Any], components: int, word: str = "components =") -> "dict[str, MadeRecord]":
    """By name of the component; keys are those of [ground.made]; `word` names their number in a message. Raises
    SceneError."""
    from masonry.scene.tables.dynamics.made_record import COMPONENTS

    table = table_of(keys)
    if not isinstance(components, int) or not 1 <= components <= len(COMPONENTS):
        raise SceneError(f"{word} {components!r:.20}: 1, 2 or 3")
    return {name: table.record(name) for name in COMPONENTS[:components]}


def table_of(keys: Mapping[str, Any]) -> Any:
    """The table [ground.made] that keys make."""
    from pydantic import ValidationError, create_model

    from masonry.scene.messages import explain
    from masonry.scene.source import Source
    from masonry.scene.tables.dynamics.made_record import MadeGround

    raw = dict(keys)
    of_a_scene = {"ground": {"made": raw}}
    ground = create_model("GroundThatIsMade", made=(MadeGround, ...))
    scene: Any = create_model("SceneOfGround", ground=(ground, ...))
    try:
        return scene.model_validate(of_a_scene).ground.made
    except ValidationError as error:
        raise explain(error, Source("masonry record", "record", "", of_a_scene)) from None


def write_records(path: Path, records: dict[str, Any]) -> None:
    """Write them as CSV, whole or not at all. Raises SceneError."""
    from geometry.files.atomic import whole_file
    from masonry.runtime.folder import writing

    first = next(iter(records.values()))
    table = np.column_stack([first.time, *(record.acceleration for record in records.values())])
    head = ",".join(["time (s)", *(f"{name} (m/s2)" for name in records)])
    with writing(path), whole_file(path) as beside:
        np.savetxt(beside, table, fmt=["%.9g", *["%.6f"] * len(records)], delimiter=",", header=head, comments="")
