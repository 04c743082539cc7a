"""history.h5: the rows, the frames and the specimen of a run, enough to draw its pictures again.

Layout: `rows/<column>` with attribute `unit`; `frames/<field of Frame>` with one entry a frame; `specimen`, `joints`
and (with tets) `mesh` with the fields of the geometry floor; attributes of `joints/properties`, an array with a number
for each contact group. h5py's default file version, which survives a killed process.
"""

from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen, TetMesh
from geometry.files.hdf5 import new_file, require_plain
from masonry.results.validate import require_whole_result
from masonry.rows.columns import CRUSHING, unit_of
from masonry.rows.history import Frame, History

if TYPE_CHECKING:
    from masonry.results.data import ResultData

VERSION = 1
FRAME_UNITS = {
    "step": "1",
    "time": "s",
    "normal_stress": "Pa",
    "shear_stress": "Pa",
    "stress": "Pa",
    "damage_tension": "1",
    "damage_shear": "1",
}
"""Units of a frame's fields; the others are lengths in m."""
NOT_WRITTEN = ("shear",)
"""Fields of a frame that only the run itself looks at."""


def write(path: Path, result: "ResultData") -> None:
    """Write history.h5. Raises OSError."""
    import h5py

    with new_file(path) as file:
        file.attrs["format"] = "masonry history"
        file.attrs["version"] = VERSION
        file.create_dataset("scene", data=result.scene_toml, dtype=h5py.string_dtype())
        file.create_dataset("log", data=np.array(result.log, dtype=object), dtype=h5py.string_dtype())
        rows = file.create_group("rows")
        for name, values in result.history.rows.items():
            rows.create_dataset(name, data=values).attrs["unit"] = result.history.unit(name)
        _write_frames(file.create_group("frames"), result.history.frames)
        specimen = file.create_group("specimen")
        specimen.attrs["section"] = result.specimen.section
        specimen.attrs["shape"] = result.specimen.shape
        _write_arrays(specimen.create_group("blocks"), result.specimen.blocks)
        sets = specimen.create_group("sets")
        for number, (name, members) in enumerate(result.specimen.sets.items()):
            sets.create_dataset(str(number), data=np.asarray(members, dtype=np.int64)).attrs["name"] = name
        joints = file.create_group("joints")
        _write_arrays(joints, result.joints)
        joints.attrs["groups"] = list(result.joint_groups)
        joints.create_dataset("group", data=result.joint_group)
        properties = joints.create_group("properties")
        for name, values in result.joint_properties.items():
            properties.attrs[name] = values
        if result.mesh is not None:
            _write_arrays(file.create_group("mesh"), result.mesh)


def read(path: Path) -> dict[str, Any]:
    """The fields of a ResultData but its summary. Raises OSError, RuntimeError, KeyError, TypeError, AttributeError or
    ValueError (GeometryError among them) for a file that is damaged, or whose arrays do not fit together.
    """
    import h5py

    with h5py.File(path, "r") as file:
        require_plain(file, path)
        if file.attrs.get("format") != "masonry history" or file.attrs["version"] > VERSION:
            raise ValueError("not a history that this version can read")
        specimen = file["specimen"]
        sets = sorted(specimen["sets"].items(), key=lambda item: int(item[0]))
        parts = {
            "history": History(
                {name: data[()] for name, data in file["rows"].items()},
                _read_frames(file["frames"]),
                _units(file["rows"]),
            ),
            "specimen": Specimen(
                blocks=_read_arrays(specimen["blocks"], Blocks),
                sets={str(data.attrs["name"]): data[()] for _, data in sets},
                section=float(specimen.attrs["section"]),
                shape=str(specimen.attrs["shape"]),
            ),
            "joints": _read_arrays(file["joints"], Joints),
            "joint_group": file["joints"]["group"][()],
            "joint_groups": tuple(str(name) for name in file["joints"].attrs["groups"]),
            "joint_properties": _joint_properties(file["joints"]),
            "mesh": _read_arrays(file["mesh"], TetMesh) if "mesh" in file else None,
            "scene_toml": file["scene"].asstr()[()],
            "log": list(file["log"].asstr()[()]),
        }
    require_whole_result(**parts)
    return parts


def _units(rows: Any) -> dict[str, str]:
    """Of columns that have another one than their name says."""
    units = {name: str(data.attrs.get("unit", unit_of(name))) for name, data in rows.items()}
    return {name: unit for name, unit in units.items() if unit != unit_of(name)}


def _joint_properties(joints: Any) -> dict[str, np.ndarray]:
    """By name; none in the file of an older version."""
    attributes = joints["properties"].attrs if "properties" in joints else {}
    return {str(name): np.asarray(values) for name, values in attributes.items()}


def _write_arrays(group: Any, value: Blocks | Joints | TetMesh) -> None:
    """Every array of a dataclass as a dataset, every other field as an attribute."""
    for entry in fields(value):
        content = getattr(value, entry.name)
        if content is None:
            continue
        if isinstance(content, np.ndarray):
            group.create_dataset(entry.name, data=content, **_packing(content.size))
        else:
            group.attrs[entry.name] = list(content) if isinstance(content, tuple) else content


def _read_arrays(group: Any, kind: type) -> Any:
    import h5py

    if not isinstance(group, h5py.Group):
        raise ValueError(f"'{group.name}' is no group of arrays")
    content: dict[str, Any] = {}
    for entry in fields(kind):
        if entry.name in group:
            content[entry.name] = group[entry.name][()]
        elif entry.name == "groups":
            content["groups"] = tuple(str(name) for name in group.attrs["groups"])
        elif entry.name in group.attrs:
            content[entry.name] = int(group.attrs[entry.name])
    return kind(**content)


def _write_frames(group: Any, frames: list[Frame]) -> None:
    group.attrs["count"] = len(frames)
    for entry in fields(Frame) if frames else ():
        if getattr(frames[0], entry.name) is None or entry.name in NOT_WRITTEN:
            continue
        first = np.asarray(getattr(frames[0], entry.name))
        packing = _packing(first.size)
        shape = (len(frames), *first.shape)
        if packing:
            data = group.create_dataset(entry.name, shape=shape, dtype=first.dtype, chunks=(1, *first.shape), **packing)
            for number, frame in enumerate(frames):
                data[number] = getattr(frame, entry.name)
        else:  # small ones in one go: each call of HDF5 costs as much as writing a thousand numbers
            every = [getattr(frame, entry.name) for frame in frames]
            data = group.create_dataset(entry.name, data=np.array(every, dtype=first.dtype).reshape(shape))
        data.attrs["unit"] = FRAME_UNITS.get(entry.name, "m")


def _read_frames(group: Any) -> list[Frame]:
    count = int(group.attrs["count"])
    if not count:
        return []
    names = [entry.name for entry in fields(Frame) if entry.name not in NOT_WRITTEN]
    names = [name for name in names if name in group or name != CRUSHING]
    whole = {name: group[name][()] for name in names}
    kinds = {"step": int, "time": float, "displacement": float}
    return [
        Frame(**{name: kinds[name](data[number]) if name in kinds else data[number] for name, data in whole.items()})
        for number in range(count)
    ]


def _packing(size: int) -> dict[str, Any]:
    """Compression for arrays that are large enough to gain from it. Whole numbers come again in what is regular or at
    rest: without a shuffle of their bytes files are a third smaller, and written in two thirds of the time."""
    return {"compression": "gzip", "compression_opts": 1} if size > 512 else {}
