"""The native file of a specimen, .blocks.h5: what was imported or built, bit for bit.

HDF5 in h5py's default file version. `about` is a JSON text in bytes: format, version, names of groups and sets,
section and shape, and by how much blocks overlap, where an import left that. `blocks/`, with tets `mesh/`, and with
stated joints `joints/` hold the arrays of the geometry floor, `sets/0`, `sets/1`, ... block numbers. Version 2 is
written where joints are stated, so that programs that do not know them refuse it; all else is version 1.
Arrays are int64 or float64.
"""

import json
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import Blocks, GeometryError, JointPolygons, Specimen, TetMesh
from geometry.files.atomic import require_file, whole_file
from geometry.files.hdf5 import new_file, require_plain
from geometry.polyhedra.validate import require_sound, require_sound_joints, require_sound_mesh

FORMAT, VERSION, WITH_JOINTS = "masonry blocks", 1, 2
LARGEST = 4 * 2**30
"""Bytes of a file that is read."""
DEEPEST = 1.0
"""m, of an overlap of blocks that an import may leave."""
LONGEST_TEXT = 2**24
"""Bytes of `about`."""


def save_blocks(path: Path, specimen: Specimen, mesh: TetMesh | None = None) -> None:
    """Write a specimen, and the tets inside it; the file appears whole or not at all. GeometryError if it cannot."""
    about = {
        "format": FORMAT,
        "version": VERSION if specimen.joints is None else WITH_JOINTS,
        "groups": list(specimen.blocks.groups),
        "sets": list(specimen.sets),
        "section": float(specimen.section),
        "shape": specimen.shape,
        **({"overlap": float(specimen.overlap)} if specimen.overlap else {}),
    }
    with whole_file(path) as place, new_file(place) as file:
        file.create_dataset("about", data=np.frombuffer(json.dumps(about).encode(), dtype=np.uint8))
        _write(file.create_group("blocks"), specimen.blocks)
        sets = file.create_group("sets")
        for number, members in enumerate(specimen.sets.values()):
            sets.create_dataset(str(number), data=np.asarray(members, dtype=np.int64))
        if mesh is not None:
            _write(file.create_group("mesh"), mesh)
        if specimen.joints is not None:
            _write(file.create_group("joints"), specimen.joints)


def load_blocks(path: Path) -> tuple[Specimen, TetMesh | None]:
    """Blocks written by save_blocks. Everything is checked; GeometryError, with one message, for any other file."""
    import h5py

    require_file(path, LARGEST)
    try:
        with h5py.File(path, "r") as file:
            require_plain(file, path)
            return _read(file)
    except GeometryError as error:
        raise GeometryError(f"'{path}': {error}") from None
    except (OSError, RuntimeError, LookupError, ValueError, TypeError, AttributeError, OverflowError) as error:
        raise GeometryError(f"'{path}' is damaged, or no file of blocks ({error})") from None


def _read(file: Any) -> tuple[Specimen, TetMesh | None]:
    about = _about(file)
    blocks = Blocks(groups=tuple(about["groups"]), **_arrays(file["blocks"], Blocks))
    require_sound(blocks)
    sets = {}
    for number, name in enumerate(about["sets"]):
        members = _array(file["sets"], str(number))
        if members.ndim != 1 or members.dtype.kind != "i" or np.any((members < 0) | (members >= blocks.count)):
            raise GeometryError(f"set '{name}' names blocks that do not exist")
        sets[name] = members
    mesh = None
    if "mesh" in file:
        mesh = TetMesh(**_arrays(file["mesh"], TetMesh))
        require_sound_mesh(blocks, mesh)
    joints = None
    if about["version"] == WITH_JOINTS:
        joints = JointPolygons(**_arrays(file["joints"], JointPolygons))
        require_sound_joints(blocks, joints)
    overlap = float(about.get("overlap", 0.0))
    return Specimen(blocks, sets, float(about["section"]), about["shape"], joints=joints, overlap=overlap), mesh


def _about(file: Any) -> dict[str, Any]:
    text = _array(file, "about")
    if text.dtype != np.uint8 or text.ndim != 1 or len(text) > LONGEST_TEXT:
        raise GeometryError("no file of blocks: 'about' is no text")
    about = json.loads(text.tobytes().decode())
    if not isinstance(about, dict) or about.get("format") != FORMAT:
        raise GeometryError("no file of blocks")
    if about.get("version") not in (VERSION, WITH_JOINTS):
        raise GeometryError(
            f"version {about.get('version')!r} of the file is unknown; this program reads {VERSION} and {WITH_JOINTS}"
        )
    for name in ("groups", "sets"):
        if not isinstance(about.get(name), list) or not all(isinstance(word, str) for word in about[name]):
            raise GeometryError(f"the names of the {name} are no list of words")
        if len(set(about[name])) != len(about[name]):
            raise GeometryError(f"two of the {name} have the same name")
    section = about.get("section")
    if not isinstance(section, float) or not np.isfinite(section) or section <= 0:
        raise GeometryError(f"the section is {section!r}, it must be an area above 0 m2")
    if not isinstance(about.get("shape"), str):
        raise GeometryError("the shape is no word")
    overlap = about.get("overlap", 0.0)
    if not isinstance(overlap, float) or not 0 <= overlap <= DEEPEST:
        raise GeometryError(f"the overlap is {overlap!r}, it must be a length from 0 to {DEEPEST:g} m")
    return about


def _write(group: Any, value: Blocks | TetMesh | JointPolygons) -> None:
    for entry in fields(value):
        content = getattr(value, entry.name)
        if isinstance(content, np.ndarray):
            group.create_dataset(entry.name, data=content.astype(float if content.dtype.kind == "f" else np.int64))


def _arrays(group: Any, kind: type) -> dict[str, np.ndarray]:
    return {entry.name: _array(group, entry.name) for entry in fields(kind) if entry.name != "groups"}


def _array(group: Any, name: str) -> np.ndarray:
    import h5py

    data = group.get(name)
    if not isinstance(data, h5py.Dataset) or data.dtype not in (np.float64, np.int64, np.uint8):
        raise GeometryError(f"'{name}' is missing, or no array of numbers")
    return np.asarray(data[()])
