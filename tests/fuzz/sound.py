"""Small sound files of every format that is read, made once in a process: what bad input is made of."""

import json
import tempfile
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import meshio
import numpy as np

from geometry.blocks import Blocks, Specimen
from geometry.files.blocks_h5 import save_blocks
from geometry.files.export import export
from geometry.joints.nearby import Rule, nearby_joints
from geometry.meshes.fan_tets import fan_tets
from geometry.meshes.gmsh_session import gmsh_model
from geometry.specimens.stacked import couplet
from masonry.results.store import NUMBERS
from masonry.scene import packaged
from tests.geometry.files import compas_samples as samples
from tests.results.sample import sample

PLANE = Path(__file__).resolve().parents[1] / "geometry" / "files" / "plane.tess"


@cache
def small() -> Specimen:
    """Two units, one above the other, and plates."""
    return couplet(0.2, 0.05, 0.05, (1, 1, 1), plates=0.02)


@cache
def scenes() -> list[str]:
    """The packaged scenes, as TOML."""
    return [file.read_text(encoding="utf-8") for file in packaged().values()]


@cache
def results() -> dict[str, bytes]:
    """Name -> content of what a run leaves."""
    result = sample()
    result.summary |= {"gauges": {"deflection": {"at_peak_m": 1e-5, "final_m": 2e-5}}, "warnings": ["none"]}
    result.history.rows["deflection"] = result.history.rows["displacement"] / 2
    result.scene_toml += '[curve]\nx = "deflection"\ny = "force"\n'
    with tempfile.TemporaryDirectory() as folder:
        result.save_numbers(Path(folder))
        return {name: (Path(folder) / name).read_bytes() for name in NUMBERS}


def _written(suffix: str, write: Callable[[Path], None]) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"seed{suffix}"
        write(path)
        return path.read_bytes()


@cache
def step() -> tuple[bytes, ...]:
    """As this program writes it, and as a CAD kernel does."""
    return _written(".step", lambda path: export(path, small())), cad(".step")


@cache
def cad(suffix: str) -> bytes:
    """Two boxes and a drilled one."""

    def write(path: Path) -> None:
        with gmsh_model({}) as gmsh:
            occ = gmsh.model.occ
            occ.addBox(0, 0, 0, 250, 120, 60)
            occ.addBox(0, 0, 60, 250, 120, 60)
            occ.cut([(3, occ.addBox(300, 0, 0, 250, 120, 60))], [(3, occ.addCylinder(425, 60, -1, 0, 0, 62, 20))])
            occ.synchronize()
            gmsh.write(str(path))

    return _written(suffix, write)


@cache
def msh() -> tuple[bytes, ...]:
    """Gmsh 2.2 and 4.1, as text and binary."""
    ways = [(version, binary) for version in ("2.2", "4.1") for binary in (False, True)]
    return tuple(_written(".msh", lambda path, w=way: meshio.gmsh.write(path, _mesh(), *w)) for way in ways)


@cache
def vtu() -> tuple[bytes, ...]:
    """As text, as base64, compressed, and raw at the end of the file."""
    ways = ({"binary": False}, {"compression": None}, {"compression": "zlib"}, {"compression": "lzma"})
    return (*(_written(".vtu", lambda path, w=way: meshio.vtu.write(path, _mesh(), **w)) for way in ways), _appended())


def _mesh() -> meshio.Mesh:
    filling = fan_tets(small().blocks, np.ones(small().blocks.count, dtype=bool))
    block = np.repeat(np.arange(small().blocks.count), np.diff(filling.tet_start)).astype(np.int32)
    data = {"gmsh:physical": [block // 2 + 1], "gmsh:geometrical": [block + 1]}
    names = {"units": np.array([1, 3]), "plates": np.array([2, 3])}
    return meshio.Mesh(filling.nodes, [("tetra", filling.tets)], cell_data=data, field_data=names)


def _appended() -> bytes:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype="<f8").tobytes()
    parts = (points, np.arange(4, dtype="<i8").tobytes(), np.array([4], "<i8").tobytes(), b"\x0a")
    raw = b"".join(len(part).to_bytes(8, "little") + part for part in parts)
    starts = np.cumsum([0, *(8 + len(part) for part in parts)])
    names = ("Points", "connectivity", "offsets", "types")
    arrays = [
        f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{wide}" format="appended" offset="{at}"/>'
        for name, kind, wide, at in zip(
            names, ("Float64", "Int64", "Int64", "UInt8"), (3, 1, 1, 1), starts, strict=False
        )
    ]
    head = (
        '<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
        'header_type="UInt64"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">'
        f"<Points>{arrays[0]}</Points><Cells>{''.join(arrays[1:])}</Cells></Piece></UnstructuredGrid>"
        '<AppendedData encoding="raw">_'
    )
    return head.encode() + raw + b"</AppendedData></VTKFile>"


@cache
def blocks() -> tuple[bytes, ...]:
    """Files of blocks: without and with tets, and with joints that are stated."""
    mesh = fan_tets(small().blocks, np.ones(small().blocks.count, dtype=bool))
    stated = replace(small(), joints=nearby_joints(small().blocks, Rule(0.01, 1e-3, 0.3)))
    ways = [(small(), None), (small(), mesh), (stated, None)]
    return tuple(_written(".blocks.h5", lambda path, way=way: save_blocks(path, *way)) for way in ways)


@cache
def surfaces() -> tuple[bytes, ...]:
    """OBJ and STL as this program writes them, and binary STL and PLY."""
    import trimesh

    written = [_written(suffix, lambda path: export(path, small())) for suffix in (".obj", ".stl")]
    box = trimesh.creation.box((1.0, 2.0, 3.0))
    return (*written, *(_written(suffix, lambda path: box.export(path)) for suffix in (".stl", ".ply")))


@cache
def compas() -> tuple[bytes, ...]:
    """A model, assemblies of two versions, a list of meshes."""
    written = samples.model(), samples.assembly(), samples.assembly(1), [samples.mesh(), samples.mesh(samples.HEIGHT)]
    return tuple(json.dumps(content).encode() for content in written)


@cache
def tess() -> tuple[bytes, ...]:
    """Cells in space, and plane ones."""
    return _tess(small().blocks), PLANE.read_bytes()


def _tess(of: Blocks) -> bytes:
    lines = ["***tess", " **format", "   3.4", " **general", "   3 standard", " **cell", f"  {of.count}", "  *id"]
    lines += ["   " + " ".join(str(b + 1) for b in range(of.count)), "  *group"]
    lines += ["   " + " ".join(str(g + 1) for g in of.group), " **vertex", f"  {len(of.points)}"]
    lines += [f"   {n + 1} {x:.12f} {y:.12f} {z:.12f} 0" for n, (x, y, z) in enumerate(of.points)]
    lines += [" **edge", "  0", " **face", f"  {len(of.face_start) - 1}"]
    for f in range(len(of.face_start) - 1):
        loop = of.face_points[of.face_start[f] : of.face_start[f + 1]] + 1
        some = " ".join(map(str, loop))
        lines += [f"   {f + 1} {len(loop)} {some}", f"     {len(loop)} {some}", "     0 0 0 1", "     0 0 0 0 0"]
    lines += [" **polyhedron", f"  {of.count}"]
    for b in range(of.count):
        faces = of.faces_of(b)
        lines.append(f"   {b + 1} {len(faces)} " + " ".join(str(f + 1) for f in faces))
    return ("\n".join([*lines, "***end"]) + "\n").encode()
