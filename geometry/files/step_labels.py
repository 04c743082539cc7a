"""Names and colours of the solids of a STEP file, each with the place of its corners to find the solid again by."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice

import numpy as np
from scipy.spatial import cKDTree

from geometry.files.step_reader import Colour, Records, colours, numbers, placement, references, strings

SOLIDS = ("MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS", "FACETED_BREP")
GENERATED = ("Open CASCADE STEP translator", "NONE")
DEEPEST = 50


@dataclass(frozen=True)
class Label:
    """One solid as it stands in the assembly; corners (n, 3) in the unit of the file."""

    name: str
    colour: Colour | None
    corners: np.ndarray


@dataclass
class _Products:
    """Who is made of what: product definitions, their solids, the parts put into them."""

    entities: Records
    name: dict[int, str] = field(default_factory=dict)
    solids: dict[int, list[int]] = field(default_factory=dict)
    parts: dict[int, list[tuple[int, str, np.ndarray]]] = field(default_factory=dict)
    inner: set[int] = field(default_factory=set)
    colour: dict[int, Colour] = field(default_factory=dict)


def labels(entities: Records, maximum: int) -> list[Label]:
    """The solids of a file by walking down its assemblies; at most `maximum` of them."""
    products = _products(entities)
    uses = Counter(child for parts in products.parts.values() for child, _, _ in parts)
    solids: list[Label] = []
    corners: dict[int, np.ndarray] = {}
    roots = [p for p in products.name if p not in products.inner]
    repeated = {child for child, times in uses.items() if times > 1}
    for product, called, matrix in islice(_walk(products, roots, repeated), 10 * maximum + 1000):
        product_solids = products.solids.get(product, [])
        for solid in product_solids:
            if len(solids) == maximum:
                return solids
            if solid not in corners:
                corners[solid] = _corners(entities, solid)
            title = _title(entities, solid)
            solids.append(
                Label(
                    title if title and (len(product_solids) > 1 or not called) else called,
                    products.colour.get(solid),
                    corners[solid] @ matrix[:3, :3].T + matrix[:3, 3],
                )
            )
    return solids


def match(entries: list[Label], corners: list[np.ndarray]) -> np.ndarray:
    """(B,) number of the label that each solid with these corners (n, 3) has, or -1; in the same unit of length.

    Round solids have corners of the kernel's own making. Where only they are left, the order of the file decides.
    """
    if not entries or not corners:
        return np.full(len(corners), -1)
    key = [
        np.concatenate([c.min(axis=0), c.max(axis=0), c.mean(axis=0)]) for c in (x.corners for x in entries) if len(c)
    ]
    number = np.array([n for n, x in enumerate(entries) if len(x.corners)])
    target = np.array([np.concatenate([c.min(axis=0), c.max(axis=0), c.mean(axis=0)]) for c in corners])
    if len(key) == 0:
        return np.full(len(corners), -1)
    distance, nearest = cKDTree(np.array(key)).query(target)
    size = np.linalg.norm(target[:, 3:6] - target[:, :3], axis=1)
    result = np.where(distance <= 1e-4 * size, number[nearest], -1)
    order = np.arange(len(corners))
    return order if len(entries) == len(corners) and np.all((result == order) | (result < 0)) else result


def _products(entities: Records) -> _Products:
    of_kind: dict[str, list[int]] = {}
    for number, (kind, _) in entities.items():
        of_kind.setdefault(kind, []).append(number)
    result = _Products(entities)
    refer = {n: references(entities[n][1]) for kind in _LINKS for n in of_kind.get(kind, [])}
    for number in of_kind.get("PRODUCT_DEFINITION", []) + of_kind.get(
        "PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS", []
    ):
        result.name[number] = _product_name(entities, number)
    represented: dict[int, int] = {}
    for number in of_kind.get("SHAPE_DEFINITION_REPRESENTATION", []):
        shape, *others = [*refer[number], -1]
        owner = references(entities.get(shape, ("", ""))[1])
        if owner and owner[-1] in result.name:
            represented[others[0]] = owner[-1]
    for number in of_kind.get("SHAPE_REPRESENTATION_RELATIONSHIP", []):
        ends = refer[number]
        for first, other in (ends[:2], ends[1::-1]) if len(ends) >= 2 else ():
            if first in represented:
                represented.setdefault(other, represented[first])
    for representation, product in represented.items():
        items = references(entities.get(representation, ("", ""))[1])
        result.solids.setdefault(product, []).extend(i for i in items if entities.get(i, ("",))[0] in SOLIDS)
    _assemble(result, of_kind, refer)
    result.colour = colours(entities, of_kind, (n for numbers in result.solids.values() for n in numbers))
    return result


_LINKS = (
    "SHAPE_DEFINITION_REPRESENTATION",
    "SHAPE_REPRESENTATION_RELATIONSHIP",
    "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION",
)


def _product_name(entities: Records, definition: int) -> str:
    """Along PRODUCT_DEFINITION, its formation, its product."""
    number = definition
    for _ in range(2):
        below = references(entities.get(number, ("", ""))[1])
        if not below:
            return ""
        number = below[0]
    kind, arguments = entities.get(number, ("", ""))
    said = strings(arguments) if kind == "PRODUCT" else []
    return _meant(said[1] or said[0]) if len(said) > 1 else ""


def _assemble(products: _Products, of_kind: dict[str, list[int]], refer: dict[int, list[int]]) -> None:
    entities = products.entities
    placed: dict[int, np.ndarray] = {}
    for number in of_kind.get("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", []):
        relation, shape = [*refer[number], -1, -1][:2]
        use = references(entities.get(shape, ("", ""))[1])
        for transform in references(entities.get(relation, ("", ""))[1]):
            if entities.get(transform, ("",))[0] == "ITEM_DEFINED_TRANSFORMATION" and use:
                ends = references(entities[transform][1])
                if len(ends) == 2:
                    placed[use[-1]] = placement(entities, ends[1]) @ np.linalg.inv(placement(entities, ends[0]))
    for number in of_kind.get("NEXT_ASSEMBLY_USAGE_OCCURRENCE", []):
        ends = references(entities[number][1])
        if len(ends) >= 2:
            said = [_meant(text) for text in strings(entities[number][1])]
            called = next((text for text in said[1::-1] if text), "")
            matrix = placed.get(number, np.eye(4))
            products.parts.setdefault(ends[0], []).append((ends[1], called, matrix))
            products.inner.add(ends[1])


def _walk(products: _Products, roots: list[int], repeated: set[int]) -> Iterator[tuple[int, str, np.ndarray]]:
    """Every product in the assembly with the name and the place it has there; a repeated one by that of its use."""
    waiting = [(root, products.name[root], np.eye(4), 0) for root in reversed(roots)]
    while waiting:
        product, called, matrix, depth = waiting.pop()
        yield product, called, matrix
        if depth < DEEPEST:
            for child, use, place in reversed(products.parts.get(product, [])):
                own_name = products.name.get(child, "")
                waiting.append((child, use if use and child in repeated else own_name, matrix @ place, depth + 1))


def _corners(entities: Records, solid: int) -> np.ndarray:
    """(n, 3) the vertices below a solid, each once."""
    waiting, seen, points = [solid], {solid}, []
    while waiting:
        number = waiting.pop()
        kind, arguments = entities.get(number, ("", ""))
        if kind == "CARTESIAN_POINT":
            points.append(numbers(arguments)[:3])
            continue
        below = references(arguments)
        if kind == "EDGE_CURVE":
            below = below[:2]
        elif kind in ("ADVANCED_FACE", "FACE_SURFACE"):
            below = below[:-1]
        fresh = [n for n in below if n not in seen]
        seen.update(fresh)
        waiting += fresh
    return np.array([p for p in points if len(p) == 3]).reshape(-1, 3)


def _title(entities: Records, solid: int) -> str:
    said = strings(entities[solid][1])
    return _meant(said[0]) if said else ""


def _meant(text: str) -> str:
    """The last part of a path; nothing for a name that a program made up."""
    text = text.strip().rsplit("/", 1)[-1]
    return "" if text.startswith(GENERATED) else text
