"""What is counted in the house: kinds asked for at the place of use, long functions, names that stand twice.

    .venv/bin/python tests/house_counts.py [CHECKOUT]

prints the table for this checkout or another one. `tests/test_house.py` holds each count to its limit.
"""

import ast
import re
import sys
from collections import Counter
from collections.abc import Callable, Collection, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PRODUCT = ("masonry", "geometry", "verification")
COMPILED = ("kernels", "patches", "laws", "simd", "kinematics", "detection")
"""Rooms of `masonry` whose functions are compiled: their length is no sign of how they read."""
KINDS = {"rigid", "affine", "tets", "turning", "deforming", "deforming_tets", "small", "large"}
"""Words for how a block deforms and how far it moves."""
PARTICIPLES = {"found", "kept", "held", "given", "told", "asked", "anew"}
QUANTIFIERS = {"one", "least", "most", "own", "left", "off", "share", "wanted", "beyond", "much"}
"""Words that say how much of what, in place of ratio, excess, error, minimum, maximum, remaining."""


class Source:
    """The files of a checkout, parsed once."""

    def __init__(self, root: Path) -> None:
        self.text = {
            path.relative_to(root): path.read_text(encoding="utf-8")
            for package in (*PRODUCT, "tests")
            for path in sorted((root / package).rglob("*.py"))
        }
        self.trees = {path: ast.parse(text) for path, text in self.text.items() if path.parts[0] != "tests"}

    def of(self, package: str) -> Iterator[tuple[Path, ast.Module]]:
        """The parsed files of a package."""
        return ((path, tree) for path, tree in self.trees.items() if path.parts[0] == package)


def lines_that_match(source: Source, pattern: str, package: str = "masonry") -> list[str]:
    """`file:line` of each line of a package that a regular expression matches."""
    expression = re.compile(pattern)
    return [
        f"{path}:{number}"
        for path, text in source.text.items()
        if path.parts[0] == package
        for number, line in enumerate(text.splitlines(), 1)
        if expression.search(line)
    ]


def compared_with_kinds(source: Source) -> list[str]:
    """`file:line` of each comparison with a word for a kind of deformation or displacement."""
    places = []
    for path, tree in source.of("masonry"):
        for node in ast.walk(tree):
            if isinstance(node, ast.Compare):
                words = {
                    value.value
                    for side in (node.left, *node.comparators)
                    for value in ast.walk(side)
                    if isinstance(value, ast.Constant) and isinstance(value.value, str)
                }
                if words & KINDS:
                    places.append(f"{path}:{node.lineno}")
    return places


def plans_told_apart(source: Source) -> list[str]:
    """`file:line` of each isinstance of a plan or a loading: of something so called, or of a class that is one."""
    classes = {"Controlled", "Growing", "Program"}
    places = []
    for path, tree in source.of("masonry"):
        for node in ast.walk(tree):
            if not (isinstance(node, ast.Call) and getattr(node.func, "id", "") == "isinstance"):
                continue
            names = {getattr(part, "id", getattr(part, "attr", "")) for part in ast.walk(node)}
            if names & {"plan", "loading"} or names & classes or any(name.endswith("Loading") for name in names):
                places.append(f"{path}:{node.lineno}")
    return places


def functions(source: Source) -> Iterator[tuple[str, ast.FunctionDef]]:
    """Every function of `masonry` that is not compiled, with its place."""
    for path, tree in source.of("masonry"):
        if path.parts[1] not in COMPILED:
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef):
                    yield f"{path}:{node.name}", node


def lines_of(function: ast.FunctionDef) -> int:
    """Lines of a function without its docstring."""
    begun = function.body[0]
    docstring = isinstance(begun, ast.Expr) and isinstance(begun.value, ast.Constant)
    first = function.body[1].lineno if docstring and len(function.body) > 1 else begun.lineno
    return (function.end_lineno or first) - first + 1


def branches_of(function: ast.FunctionDef) -> int:
    """Places of a function where its way divides: if, loops, conditional expressions, handlers, and, or."""
    kinds = (ast.If, ast.IfExp, ast.For, ast.While, ast.ExceptHandler, ast.comprehension)
    nodes = list(ast.walk(function))
    joined = sum(len(node.values) - 1 for node in nodes if isinstance(node, ast.BoolOp))
    return sum(isinstance(node, kinds) for node in nodes) + joined


def attributes_of_loadings(source: Source) -> dict[str, int]:
    """How many attributes each class whose name ends in Loading sets on itself, or declares, its parents' apart."""
    counts = {}
    for path, tree in source.of("masonry"):
        for node in ast.walk(tree):
            if isinstance(node, ast.ClassDef) and node.name.endswith("Loading"):
                names = {
                    part.attr
                    for part in ast.walk(node)
                    if isinstance(part, ast.Attribute)
                    and isinstance(part.ctx, ast.Store)
                    and getattr(part.value, "id", "") == "self"
                }
                names |= {
                    part.target.id
                    for part in node.body
                    if isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name)
                }
                counts[f"{path}:{node.name}"] = len(names)
    return counts


def repeated_classes(source: Source) -> dict[str, int]:
    """Names of classes that stand more than once in what is shipped."""
    names = Counter(
        node.name for tree in source.trees.values() for node in ast.walk(tree) if isinstance(node, ast.ClassDef)
    )
    return {name: count for name, count in sorted(names.items()) if count > 1}


def repeated_files(source: Source) -> dict[str, int]:
    """Names of files that stand more than once in `masonry`."""
    names = Counter(path.stem for path, _ in source.of("masonry") if path.stem != "__init__")
    return {name: count for name, count in sorted(names.items()) if count > 1}


def lines_with_names(source: Source, names: Collection[str]) -> int:
    """Lines of code that use one of these words alone as a name, docstrings and words of messages apart."""
    places = set()
    for path, tree in source.trees.items():
        for node in ast.walk(tree):
            name = getattr(node, "id", getattr(node, "attr", getattr(node, "arg", None)))
            if isinstance(node, ast.Name | ast.Attribute | ast.arg) and name in names:
                places.add((path, node.lineno))
    return len(places)


def naming_bars(source: Source) -> list[str]:
    """`file:line` of each line of `masonry` that names a class, a room, a field or a column of bars."""
    names = r"Bar(Table|Places|Element|Record)\b|Bars\b|_BARS\b|is_bar\b|\.bars?\b(?!\()|\bbars="
    rooms = r"(elements|kernels|assembly)\.bars|bar_(element|places|lines|row|ends|limits)"
    return lines_that_match(source, rf"^(?!\s*\"\"\").*({names}|{rooms})")


def fields_of(source: Source, name: str) -> int:
    """How many fields a class of `masonry` declares, or how many fields, methods and properties a protocol."""
    classes = (
        node
        for _, tree in source.of("masonry")
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef) and node.name == name
    )
    return sum(
        isinstance(part, ast.AnnAssign)
        or (isinstance(part, ast.FunctionDef) and any(getattr(base, "id", "") == "Protocol" for base in node.bases))
        for node in classes
        for part in node.body
    )


def _files(places: list[str]) -> int:
    return len({place.partition(":")[0] for place in places})


COUNTS: dict[str, Callable[[Source], int]] = {
    "lines of masonry that read .large": lambda s: len(lines_that_match(s, r"^(?!\s*(from|import) ).*\.large\b")),
    "files of masonry that compare .large with None": lambda s: _files(lines_that_match(s, r"\blarge is (not )?None")),
    "asserts that .large is there": lambda s: len(lines_that_match(s, r"assert .*large is not None")),
    "comparisons with a word for a kind of deformation or displacement": lambda s: len(compared_with_kinds(s)),
    "isinstance of a plan or a loading": lambda s: len(plans_told_apart(s)),
    "lines of the longest function that is not compiled": lambda s: max(lines_of(f) for _, f in functions(s)),
    "branches of the function that branches most": lambda s: max(branches_of(f) for _, f in functions(s)),
    "attributes of the loading that has most": lambda s: max(attributes_of_loadings(s).values(), default=0),
    "class names that stand more than once": lambda s: len(repeated_classes(s)),
    "file names that stand more than once in masonry": lambda s: len(repeated_files(s)),
    "lines with `found`, tests included": lambda s: sum(
        len(lines_that_match(s, r"\bfound\b", package)) for package in (*PRODUCT, "tests")
    ),
    "lines that name something by a participle alone": lambda s: lines_with_names(s, PARTICIPLES),
    "lines that name a number by how much it is": lambda s: lines_with_names(s, QUANTIFIERS),
    "docstrings that begin with What": lambda s: sum(
        len(lines_that_match(s, r'^\s*"""What\b', package)) for package in PRODUCT
    ),
    "lines of masonry that ask whether there are bars": lambda s: len(lines_that_match(s, r"\bbars is (not )?None")),
    "lines of masonry that ask whether joints crush": lambda s: len(lines_that_match(s, r"\bcrushed is (not )?None")),
    "files of masonry that name bars": lambda s: _files(naming_bars(s)),
    "fields of a model": lambda s: fields_of(s, "Model"),
    "members of a configuration": lambda s: fields_of(s, "Configuration"),
}
"""What is counted: in words, and how."""


def main() -> None:
    """Print the table, and the places of the largest."""
    source = Source(Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT)
    for words, count in COUNTS.items():
        print(f"{count(source):6} {words}")
    print("longest:", *sorted(((lines_of(f), place) for place, f in functions(source)), reverse=True)[:5])
    print("branches:", *sorted(((branches_of(f), place) for place, f in functions(source)), reverse=True)[:5])
    print("loadings:", attributes_of_loadings(source))
    print("classes:", repeated_classes(source))
    print("files:", repeated_files(source))


if __name__ == "__main__":
    main()
