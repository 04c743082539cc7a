"""Blocks as a STEP file (ISO 10303-21, AUTOMOTIVE_DESIGN): one product with one solid for each block, in metres.

Written as text, because a CAD kernel takes minutes for some thousand blocks and rounds their corners to millimetres.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from geometry.blocks import Blocks
from geometry.meshes.skeleton import split_edges, weld_loops
from geometry.polyhedra.indexing import Lists, following
from geometry.polyhedra.measures import extent, face_areas_normals_centroids

WIDTH = 1e-9
"""Of the longest side: corners nearer than this are one, and on an edge when they are that near to it."""
HEAD = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('blocks of a masonry specimen'),'2;1');
FILE_NAME('blocks','',(''),(''),'','masonry','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
"""
TAIL = "ENDSEC;\nEND-ISO-10303-21;\n"


class _Entities:
    """Lines of a STEP file with their numbers."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.count = 0

    def add(self, text: str) -> str:
        self.count += 1
        self.lines.append(f"#{self.count} = {text};\n")
        return f"#{self.count}"

    def take(self) -> str:
        text, self.lines = "".join(self.lines), []
        return text


def step_text(blocks: Blocks, names: Sequence[str]) -> Iterator[str]:
    """The file in pieces, block by block; names (B,) become the names of products and solids."""
    step = _Entities()
    yield HEAD
    application = step.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')")
    step.add(f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})")
    context = _units(step)
    origin = _axes(step, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    whole = _product(step, application, "specimen")
    assembly = step.add(f"SHAPE_REPRESENTATION('',({origin}),{context})")
    step.add(f"SHAPE_DEFINITION_REPRESENTATION({step.add(_shape(whole))},{assembly})")
    normal = face_areas_normals_centroids(blocks)[1]
    width = WIDTH * extent(blocks)
    for b, name in enumerate(names):
        solid = _solid(step, blocks, b, name, normal, width)
        part = _product(step, application, name)
        shape = step.add(f"ADVANCED_BREP_SHAPE_REPRESENTATION('',({origin},{solid}),{context})")
        step.add(f"SHAPE_DEFINITION_REPRESENTATION({step.add(_shape(part))},{shape})")
        _add_to_assembly(step, whole, part, shape, assembly, origin, b + 1)
        yield step.take()
    yield TAIL


def _shape(product: str) -> str:
    """The shape of a product definition."""
    return f"PRODUCT_DEFINITION_SHAPE('','',{product})"


def quoted(text: str) -> str:
    """A string of ISO 10303-21: quotes and backslashes doubled, what is not ASCII as \\X2\\ or \\X4\\ codes."""
    parts = []
    for letter in text:
        code = ord(letter)
        if code < 32 or code == 127:
            parts.append(" ")
        elif code < 127:
            parts.append({"'": "''", "\\": "\\\\"}.get(letter, letter))
        else:
            parts.append(f"\\X2\\{code:04X}\\X0\\" if code < 65536 else f"\\X4\\{code:08X}\\X0\\")
    return "'" + "".join(parts) + "'"


def _units(step: _Entities) -> str:
    metre = step.add("( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) )")
    radian = step.add("( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) )")
    steradian = step.add("( NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT() )")
    precision = step.add(f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-10),{metre},'distance_accuracy_value','')")
    return step.add(
        f"( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({precision})) "
        f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({metre},{radian},{steradian})) REPRESENTATION_CONTEXT('','3D') )"
    )


def _product(step: _Entities, application: str, name: str) -> str:
    """A product of this name; the number of its definition."""
    mechanical = step.add(f"PRODUCT_CONTEXT('',{application},'mechanical')")
    product = step.add(f"PRODUCT({quoted(name)},{quoted(name)},'',({mechanical}))")
    step.add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))")
    formation = step.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
    design = step.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')")
    return step.add(f"PRODUCT_DEFINITION('design','',{formation},{design})")


def _add_to_assembly(
    step: _Entities, whole: str, part: str, shape: str, assembly: str, origin: str, number: int
) -> None:
    """The part in the whole, where it stands."""
    transformation = step.add(f"ITEM_DEFINED_TRANSFORMATION('','',{origin},{origin})")
    relation = step.add(
        f"( REPRESENTATION_RELATIONSHIP('','',{shape},{assembly}) "
        f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({transformation}) SHAPE_REPRESENTATION_RELATIONSHIP() )"
    )
    usage = step.add(f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{number}','','',{whole},{part},$)")
    placement = step.add(f"PRODUCT_DEFINITION_SHAPE('Placement','Placement of an item',{usage})")
    step.add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{placement})")


def _solid(step: _Entities, blocks: Blocks, b: int, name: str, normal: np.ndarray, width: float) -> str:
    vertices, loops = _shell(blocks, b, width)
    place = [_point(step, v) for v in vertices]
    vertex = [step.add(f"VERTEX_POINT('',{p})") for p in place]
    edges: dict[tuple[int, int], str] = {}
    faces = []
    for f, loop in zip(blocks.faces_of(b), loops, strict=True):
        oriented = []
        for i, j in zip(loop, loop[1:] + loop[:1], strict=True):
            key = (min(i, j), max(i, j))
            if key not in edges:
                direction = vertices[key[1]] - vertices[key[0]]
                vector = step.add(f"VECTOR('',{_direction(step, direction / np.linalg.norm(direction))},1.)")
                line = step.add(f"LINE('',{place[key[0]]},{vector})")
                edges[key] = step.add(f"EDGE_CURVE('',{vertex[key[0]]},{vertex[key[1]]},{line},.T.)")
            oriented.append(step.add(f"ORIENTED_EDGE('',*,*,{edges[key]},{'.T.' if i < j else '.F.'})"))
        bound = step.add(f"FACE_OUTER_BOUND('',{step.add(_list('EDGE_LOOP', oriented))},.T.)")
        across = np.cross(normal[f], np.eye(3)[np.argmin(np.abs(normal[f]))])
        axes = _axes(step, vertices[loop[0]], normal[f], across / np.linalg.norm(across))
        plane = step.add(f"PLANE('',{axes})")
        faces.append(step.add(f"ADVANCED_FACE('',({bound}),{plane},.T.)"))
    return step.add(f"MANIFOLD_SOLID_BREP({quoted(name)},{step.add(_list('CLOSED_SHELL', faces))})")


def _list(kind: str, members: Sequence[str]) -> str:
    """An entity that is a list of others."""
    return f"{kind}('',({','.join(members)}))"


def _shell(blocks: Blocks, b: int, width: float) -> tuple[np.ndarray, list[list[int]]]:
    """Corners and faces of a block, every edge in two faces: corners on the edges of other faces are put in."""
    faces = Lists(blocks.face_start, blocks.face_points).taken(np.array(blocks.faces_of(b)))
    vertices, loops = weld_loops(blocks.points[faces.entry], faces.start, width)
    begin, end = loops.entry.tolist(), loops.entry[following(loops.start)].tolist()
    edges = set(zip(begin, end, strict=True))
    if all((j, i) in edges for i, j in edges):
        return vertices, loops.lists()
    return vertices, split_edges(vertices, loops, width).lists()


def _axes(step: _Entities, place: Sequence[float], axis: Sequence[float], across: Sequence[float]) -> str:
    entries = _point(step, place), _direction(step, axis), _direction(step, across)
    return step.add(f"AXIS2_PLACEMENT_3D('',{','.join(entries)})")


def _point(step: _Entities, place: Sequence[float]) -> str:
    return step.add(f"CARTESIAN_POINT('',({','.join(map(_real, place))}))")


def _direction(step: _Entities, direction: Sequence[float]) -> str:
    return step.add(f"DIRECTION('',({','.join(map(_real, direction))}))")


def _real(value: float) -> str:
    """A real of ISO 10303-21, which must have a point: all digits of the double."""
    text = repr(float(value)).upper()
    if "." not in text:
        text = text.replace("E", ".E") if "E" in text else f"{text}."
    return text
