"""`masonry new bridge`: arches on piers, their fill, and a vehicle that travels over them."""

import math
from typing import Any

from masonry.starting.options import Entries, TaskOption, metres, round_up
from masonry.starting.rings import ring_of, voussoirs_of
from masonry.starting.task import DENSITY, DRY_STIFFNESS, FRICTION, StartTask

MANY = 20
"""Spans of a bridge, and axles of a vehicle."""

TEMPLATE = """\
kinematics = "rigid"
law = "friction"  # joints press and rub; nothing is glued
material.units.density = "$density"
contact.unit_unit = { normal_stiffness = "60 GPa/m", shear_stiffness = "24 GPa/m", tan_friction_angle = $friction }
support = [{ on = "foundations", fix = "all" }]  # abutments and footings
fill = [{ on = "extrados", level = "$level", density = "$fill_density" }]  # $cover above the crown; it only weighs
gravity.z = "-9.81 m/s^2"
settle.steps = 20000  # dead loads first

[specimen]  # the first arch springs at x = 0, all arches at z = 0
kind = "bridge"
depth = "$strip"  # a strip of the bridge: axles are loads on it
contact_points = "vertex"  # at the ends of the joints, so that hinges turn about the edges of the stones
arch = [  # span and rise of the intrados
$arches
]
pier = [$piers]

[vehicle]  # no position: `masonry limit` has it travel
on = "extrados"
level = "$level"  # of the road
axles = [$axles]
$spacings_line
patch = "0.3 m"  # of a wheel on the road, along x
spread = "26.565 deg"  # through the fill: 1 to 2 on either side

[limit]
pattern = "vehicle"  # the factor multiplies all axles
"""


def values(entries: Entries) -> dict[str, Any]:
    """The placeholders of TEMPLATE."""
    spans = entries.optional("spans")
    count = len(spans)
    rises = [entry.si for entry in entries.of_each("rises", count, "spans") or ()] or [0.25 * s.si for s in spans]
    rings = [entry.si for entry in entries.of_each("thickness", count, "spans") or ()]
    thick = rings or [round_up(max(0.25, s.si / 16.0), 0.05) for s in spans]
    for span, rise, ring in zip(spans, rises, thick, strict=True):
        if not 0.02 * span.si <= rise <= 0.5 * span.si:
            near = f"{0.02 * span.si:g} to {0.5 * span.si:g} m"
            raise entries.refusal("rises", f"{rise:g} m over a span of {span.text}; allowed: {near}")
        if ring >= span.si:
            raise entries.refusal("thickness", f"{ring:g} m of a span of {span.text}: a ring is thinner than its span")
    arches = "\n".join(
        f'  {{ span = "{span.text}", rise = "{metres(rise)}", thickness = "{metres(ring)}", '
        f"voussoirs = {voussoirs_of(span.si, rise, ring)} }},"
        for span, rise, ring in zip(spans, rises, thick, strict=True)
    )
    level = max(rise + ring for rise, ring in zip(rises, thick, strict=True)) + entries.si("cover")
    axles, words = _vehicle(entries)
    return {
        "title": f"Bridge of {count} span{'s' * (count > 1)} ({', '.join(s.text for s in spans)}) under {words}",
        "arches": arches,
        "piers": _piers(entries, [span.si for span in spans], rises, thick),
        "level": metres(level),
        "position": f"{0.25 * spans[0].si:.4g} m",
        **axles,
    }


def _piers(entries: Entries, spans: list[float], rises: list[float], thick: list[float]) -> str:
    """The list of piers, each wide enough for the rings that spring from it."""
    count = len(spans) - 1
    if not count:
        for name in {"pier_width", "pier_height"} & entries.chosen:
            raise entries.refusal(name, "a bridge of one span has no pier; give more --spans, or leave it out")
        return ""
    needed = [ring * math.sin(0.5 * ring_of(s, r)[1]) for s, r, ring in zip(spans, rises, thick, strict=True)]
    widths, lines = entries.of_each("pier_width", count, "piers"), []
    for n in range(count):
        both = needed[n] + needed[n + 1]
        width = widths[n].si if widths else round_up(max(0.2 * max(spans[n : n + 2]), both + 0.04), 0.05)
        if width < both:
            raise entries.refusal(
                "pier_width", f"{width:g} m; the rings that spring from pier {n + 1} need {both:.3f} m"
            )
        height = entries.si("pier_height")
        lines.append(
            f'  {{ width = "{metres(width)}", height = "{metres(height)}", '
            f"courses = {max(2, min(30, round(height / 0.4)))} }},"
        )
    return "  # between the arches\n{}\n".format("\n".join(lines))


def _vehicle(entries: Entries) -> tuple[dict[str, str], str]:
    """Axles and spacings as lists of TOML, and words for the title."""
    axles = entries.optional("axles")
    gaps = entries.of_each("spacings", len(axles) - 1, "gaps between the axles") if len(axles) > 1 else None
    if len(axles) == 1 and "spacings" in entries.chosen:
        raise entries.refusal("spacings", "a single axle has none; leave it out, or give more axles")
    listed = [", ".join(f'"{entry.text}"' for entry in part or ()) for part in (axles, gaps)]
    says = f"an axle of {axles[0].text}" if len(axles) == 1 else f"a vehicle of {len(axles)} axles"
    line = f"spacings = [{listed[1]}]" if gaps else '# spacings = ["1.2 m"]  # between several axles'
    return {"axles": listed[0], "spacings_line": line}, says


TASK = StartTask(
    "bridge",
    "one or more arches, fill, and a vehicle: what may drive over it?",
    (
        TaskOption("spans", "clear spans from left to right", default="5", allowed="[0.2, 200]", several=MANY),
        TaskOption(
            "rises",
            "of the intrados, one for all or one for each span (default: a quarter of the span)",
            allowed="(0, 100]",
            several=MANY,
        ),
        TaskOption(
            "thickness",
            "of the rings, one for all or one for each (default: a sixteenth of the span, 0.25 m or more)",
            allowed="[0.02, 10]",
            several=MANY,
        ),
        TaskOption(
            "pier_width",
            "one for all piers or one for each (default: a fifth of the larger span beside it)",
            allowed="[0.05, 100]",
            several=MANY,
        ),
        TaskOption("pier_height", "below the springings", default="3", allowed="[0.2, 200]"),
        TaskOption(
            "axles", "of the vehicle, from its first to its last", "force", "kN", "100", "(0, 1e8]", several=MANY
        ),
        TaskOption(
            "spacings", "between the axles, one for all or each", default="1.2", allowed="[0.1, 100]", several=MANY
        ),
        TaskOption("cover", "of fill above the highest crown", default="0.3", allowed="[0, 20]"),
        TaskOption(
            "strip",
            "of the bridge across that bears the axles",
            default="1",
            allowed="[0.1, 50]",
            key="specimen.depth",
            guess="a strip of 1 m bears the whole axle; codes give the effective width of an axle, 2.5 m and more",
        ),
        DENSITY,
        TaskOption(
            "fill_density",
            "of the fill",
            "density",
            "kg/m^3",
            "1800",
            "[0, 5000]",
            key="fill.0.density",
            guess="compacted soil and gravel: 1600 to 2100 kg/m3",
        ),
        FRICTION,
    ),
    TEMPLATE,
    values,
    (
        "masonry view $file",
        "masonry check $file",
        "masonry limit $file",
        'masonry run $file --set "vehicle.position=$position" --set limit.accuracy=0.01',
    ),
    (DRY_STIFFNESS, ("vehicle.spread", "1 to 2 through compacted fill, as is common; 0 is the safe side")),
)
