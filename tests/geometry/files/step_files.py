"""STEP files of walls and arches as a CAD program would write them: solids of gmsh's OCC kernel with names, in mm."""

import math
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from geometry.meshes.gmsh_session import gmsh_model

LENGTH, WIDTH, HEIGHT = 250.0, 120.0, 60.0
INCH = (
    "( CONVERSION_BASED_UNIT('INCH',#90000001) LENGTH_UNIT() NAMED_UNIT(#90000003) );\n"
    "#90000001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#90000002);\n"
    "#90000002 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n"
    "#90000003 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)"
)


def write_step(
    path: Path,
    build: Callable[[Any], None],
    names: Sequence[str] = (),
    colours: dict[str, tuple[float, float, float]] | None = None,
    inch: bool = False,
) -> Path:
    """What build(occ) makes, with names in the order of the solids and colours by name."""
    with gmsh_model({}) as gmsh:
        build(gmsh.model.occ)
        gmsh.model.occ.synchronize()
        gmsh.write(str(path))
    text = path.read_text(encoding="utf-8")
    solid = re.compile(r"#(\d+) = (MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS)\('")
    called, painted = iter(names), []

    def name(match: re.Match[str]) -> str:
        own = next(called, "")
        if colours and own in colours:
            painted.append((int(match[1]), colours[own]))
        return f"{match[0]}{own}"

    text = solid.sub(name, text)
    if inch:
        text = re.sub(r"\( LENGTH_UNIT\(\) NAMED_UNIT\(\*\) SI_UNIT\(\.MILLI\.,\.METRE\.\) \)", lambda _: INCH, text)
    styles = "".join(_style(80_000_000 + 10 * n, *item) for n, item in enumerate(painted))
    path.write_text(text.replace("ENDSEC;\nEND-ISO", f"{styles}ENDSEC;\nEND-ISO"), encoding="utf-8")
    return path


def _style(number: int, item: int, colour: tuple[float, float, float]) -> str:
    red, green, blue = colour
    lines = (
        f"STYLED_ITEM('color',(#{number + 1}),#{item})",
        f"PRESENTATION_STYLE_ASSIGNMENT((#{number + 2}))",
        f"SURFACE_STYLE_USAGE(.BOTH.,#{number + 3})",
        f"SURFACE_SIDE_STYLE('',(#{number + 4}))",
        f"SURFACE_STYLE_FILL_AREA(#{number + 5})",
        f"FILL_AREA_STYLE('',(#{number + 6}))",
        f"FILL_AREA_STYLE_COLOUR('',#{number + 7})",
        f"COLOUR_RGB('',{red},{green},{blue})",
    )
    return "".join(f"#{number + n} = {line};\n" for n, line in enumerate(lines))


def wall(columns: int, courses: int, gap: float = 0.0, scale: float = 1.0) -> Callable[[Any], None]:
    """Running bond of units 250 x 120 x 60, each shorter by gap (longer, if it is below 0)."""

    def build(occ: Any) -> None:
        for j in range(courses):
            for i in range(columns):
                x = i * LENGTH + (j % 2) * LENGTH / 2
                occ.addBox(x * scale, 0, j * HEIGHT * scale, (LENGTH - gap) * scale, WIDTH * scale, HEIGHT * scale)

    return build


def wall_names(columns: int, courses: int) -> list[str]:
    return [f"brick-{j}-{i}" for j in range(courses) for i in range(columns)]


def wall_joint_area(columns: int, courses: int, scale: float = 1e-3) -> float:
    """m2, head joints and bed joints."""
    head = (columns - 1) * courses * WIDTH * HEIGHT
    bed = (courses - 1) * (columns * LENGTH - LENGTH / 2) * WIDTH
    return (head + bed) * scale**2


def arch(voussoirs: int, inner: float = 1000.0, outer: float = 1250.0, width: float = 200.0) -> Callable[[Any], None]:
    """Half a ring of wedges with straight edges."""

    def build(occ: Any) -> None:
        for k in range(voussoirs):
            angles = math.pi * k / voussoirs, math.pi * (k + 1) / voussoirs
            places = ((inner, angles[0]), (outer, angles[0]), (outer, angles[1]), (inner, angles[1]))
            corners = [occ.addPoint(r * math.cos(a), 0, r * math.sin(a)) for r, a in places]
            lines = [occ.addLine(corners[i], corners[(i + 1) % 4]) for i in range(4)]
            occ.extrude([(2, occ.addPlaneSurface([occ.addCurveLoop(lines)]))], 0, width, 0)
        occ.synchronize()
        occ.remove([entity for entity in occ.getEntities(2)])

    return build


def perforated(units: int) -> Callable[[Any], None]:
    """A stack of units with two square holes of 40 and a round one of radius 15, along z."""

    def build(occ: Any) -> None:
        for k in range(units):
            z = k * HEIGHT
            body = occ.addBox(0, 0, z, LENGTH, WIDTH, HEIGHT)
            holes = [(3, occ.addBox(x, 40, z - 10, 40, 40, HEIGHT + 20)) for x in (30, 180)]
            holes.append((3, occ.addCylinder(LENGTH / 2, WIDTH / 2, z - 10, 0, 0, HEIGHT + 20, 15)))
            occ.cut([(3, body)], holes)

    return build
