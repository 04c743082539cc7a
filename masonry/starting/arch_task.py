"""`masonry new arch`: an arch of voussoirs under its own weight, and a load that grows: a weight on it, or a tilt."""

import math
from typing import Any

from masonry.starting.options import Entries, TaskOption
from masonry.starting.rings import ring_of, voussoirs_of
from masonry.starting.task import DENSITY, DRY_STIFFNESS, FRICTION, StartTask

TEMPLATE = """\
kinematics = "rigid"
law = "friction"  # joints press and rub; nothing is glued
material.units.density = "$density"
contact.unit_unit = { normal_stiffness = "30 GPa/m", shear_stiffness = "12 GPa/m", tan_friction_angle = $friction }
support = [{ on = "left abutment", fix = "all" }, { on = "right abutment", fix = "all" }]
gauge = [{ name = "crown", at = "keystone", direction = "z" }]
gravity.z = "-9.81 m/s^2"
settle.steps = 20000  # its own weight first

[specimen]  # springings at z = 0, its middle at x = 0
kind = "arch"
span = "$span"  # of the intrados
rise = "$rise"
thickness = "$thickness"
voussoirs = $voussoirs
depth = "$depth"
abutments = "skewbacks"
contact_points = "vertex"  # at the ends of the joints, so that hinges turn about the edges of the voussoirs

[limit]  # what grows, by a factor, until it falls
$growing
accuracy = "1 %"  # of the factor in a run; "none": a run bears the weight alone
"""
POINT = """\
pattern = "force"
on = "voussoir $loaded"  # $at from the left springing
force = { z = "-1 kN" }  # so the factor is the weight in kN that it bears there"""
TILT = """\
pattern = "tilt"  # of the ground; the factor is the tangent of the angle
about = "y\""""


def values(entries: Entries) -> dict[str, Any]:
    """The placeholders of TEMPLATE."""
    span, thickness = entries.si("span"), entries.si("thickness")
    rises, places = entries.optional("rise"), entries.optional("at")
    rise, at = rises[0].si if rises else 0.25 * span, places[0].si if places else 0.25 * span
    if not 0.02 * span <= rise <= 0.5 * span:
        near = f"{0.02 * span:g} to {0.5 * span:g} m"
        raise entries.refusal("rise", f"{rise:g} m over a span of {entries.text('span')}; allowed: {near}")
    if thickness >= span:
        raise entries.refusal("thickness", f"{thickness:g} m; it must be less than the span, {span:g} m")
    if at >= span:
        raise entries.refusal("at", f"{at:g} m; it must be less than the span, {span:g} m")
    grows = entries.text("load")
    if grows == "tilt" and places:
        raise entries.refusal("at", "a tilt has no place; leave it out, or choose the load 'point'")
    counts = entries.optional("voussoirs")
    count = int(counts[0].si) if counts else voussoirs_of(span, rise, thickness)
    radius, angle = ring_of(span, rise)
    from_crown = math.asin(max(-1.0, min(1.0, (at - 0.5 * span) / radius)))
    loaded = min(count, int((from_crown / angle + 0.5) * count) + 1)
    growing = POINT.replace("$loaded", str(loaded)).replace("$at", f"{at:g} m") if grows == "point" else TILT
    says = f"a weight {at:g} m from its left springing" if grows == "point" else "a tilt of the ground"
    return {
        "title": f"Arch of {entries.text('span')} span under its own weight and {says}",
        "rise": f"{rise:g} m",
        "voussoirs": count,
        "growing": growing,
    }


TASK = StartTask(
    "arch",
    "an arch under its own weight: does it stand, and what weight, or tilt, does it bear?",
    (
        TaskOption("span", "clear span of the intrados", default="4", allowed="[0.2, 200]"),
        TaskOption("rise", "of the intrados (default: a quarter of the span)", allowed="(0, 100]"),
        TaskOption("thickness", "of the ring", default="0.3", allowed="[0.01, 10]"),
        TaskOption("depth", "across, along y", default="1", allowed="[0.01, 100]"),
        TaskOption(
            "voussoirs", "how many (default: about two thirds as wide as thick)", "integer", "", allowed="[3, 400]"
        ),
        TaskOption("load", "that grows: a weight at a place, or a tilt", "", "", "point", words=("point", "tilt")),
        TaskOption("at", "of the weight, from the left springing (default: a quarter of the span)", allowed="(0, 200]"),
        DENSITY,
        FRICTION,
    ),
    TEMPLATE,
    values,
    ("masonry view $file", "masonry check $file", "masonry limit $file", "masonry run $file"),
    (DRY_STIFFNESS,),
)
