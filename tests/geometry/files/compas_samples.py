"""Files as COMPAS 1 and 2 write them, by hand: three bricks one on the other as a model, an assembly and meshes."""

import json
from pathlib import Path
from typing import Any

LENGTH, WIDTH, HEIGHT = 0.25, 0.12, 0.06
FACES = [[0, 1, 2, 3], [0, 3, 5, 4], [3, 2, 6, 5], [2, 1, 7, 6], [1, 0, 4, 7], [4, 5, 6, 7]]
PLAN = [(0, 0), (0, 1), (1, 1), (1, 0)]
IDENTITY = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
UP = [*IDENTITY[:2], [0.0, 0.0, 1.0, HEIGHT], IDENTITY[3]]


def corners(level: float = 0.0) -> list[list[float]]:
    """Of a brick: four below, then four above in the order of COMPAS."""
    above = [PLAN[0], PLAN[3], PLAN[2], PLAN[1]]
    return [[x * LENGTH, y * WIDTH, level] for x, y in PLAN] + [
        [x * LENGTH, y * WIDTH, level + HEIGHT] for x, y in above
    ]


def mesh_data(level: float = 0.0, version: int = 2, name: str = "") -> dict[str, Any]:
    """What a Mesh holds, quads as they are."""
    usual = {"x": 0.0, "y": 0.0, "z": 0.0}
    data: dict[str, Any] = {"attributes": {"name": name} if version == 1 else {}}
    keys = ("dva", "dea", "dfa")
    if version == 2:
        keys = ("default_vertex_attributes", "default_edge_attributes", "default_face_attributes")
    data |= dict(zip(keys, (usual, {}, {}), strict=True))
    data |= {"vertex": {str(n): dict(zip("xyz", at, strict=True)) for n, at in enumerate(corners(level))}}
    data |= {"face": {str(n): face for n, face in enumerate(FACES)}, "facedata": {}, "edgedata": {}}
    return data | {"max_vertex": 7, "max_face": 5}


def thing(dtype: str, data: Any, version: int = 2, **more: Any) -> dict[str, Any]:
    """An object with its class."""
    return {"dtype": dtype, ("data" if version == 2 else "value"): data, "guid": f"{len(str(data)):032x}", **more}


def mesh(level: float = 0.0, version: int = 2, name: str = "") -> dict[str, Any]:
    more = {"name": name} if name and version == 2 else {}
    return thing("compas.datastructures/Mesh", mesh_data(level, version, name), version, **more)


def assembly(version: int = 2) -> dict[str, Any]:
    """Of compas_assembly: blocks at the nodes of a graph; the lowest is a support, the interfaces are at the edges."""
    block = "compas_assembly.datastructures/Block"
    nodes = {str(k): {"block": thing(block, mesh_data(k * HEIGHT, version), version)} for k in range(3)}
    nodes["0"]["is_support"] = True
    interface = {"interfaces": [thing("compas_assembly.datastructures/Interface", {"size": 0.03}, version)]}
    graph: dict[str, Any] = {"attributes": {}, "node": nodes, "edge": {"0": {"1": interface}, "1": {"2": interface}}}
    held = thing("compas.datastructures/Graph", graph) if version == 2 else {**graph, "dna": {}, "adjacency": {}}
    return thing(
        "compas_assembly.datastructures/Assembly", {"attributes": {"name": "Assembly"}, "graph": held}, version
    )


def matrix(rows: list[list[float]]) -> dict[str, Any]:
    return thing("compas.geometry/Transformation", {"matrix": rows})


def element(guid: str, place: Any = None, is_support: bool = False, geometry: Any = None, name: str = "Block") -> Any:
    """A Block of compas_dem; without another geometry a brick on the ground."""
    data = {"features": [], "geometry": mesh() if geometry is None else geometry, "is_support": is_support}
    data |= {"material": None, "name": name, "transformation": place}
    return {"dtype": "compas_dem.elements/Block", "data": data, "guid": guid}


def model(place: Any = None, **elements: Any) -> dict[str, Any]:
    """A BlockModel of compas_dem: b stands on a, c within a group that is raised by one, by one itself."""
    group = {"features": [], "material": None, "name": "upper", "transformation": matrix(UP)}
    there = {
        "a": element("a", is_support=True),
        "b": element("b", matrix(UP), name="middle"),
        "g": {"dtype": "compas_model.elements/Group", "data": group, "guid": "g", "name": "upper"},
        "c": element("c", matrix(UP)),
        **elements,
    }
    node = {"name": "ElementNode"}
    root = {"name": "root", "children": [{"element": "a", **node}, {"element": "b", **node}]}
    root["children"].append({"element": "g", **node, "children": [{"element": "c", **node}]})
    graph = {"node": {str(n): {"element": key} for n, key in enumerate(there)}, "edge": {"0": {"1": {"contacts": []}}}}
    data = {"elements": there, "graph": graph, "materials": {}, "transformation": place}
    return thing("compas_dem.models/BlockModel", data | {"tree": {"attributes": {}, "root": root}})


def write(path: Path, content: Any) -> Path:
    path.write_text(json.dumps(content), encoding="utf-8")
    return path
