"""The scene that `masonry import` writes: it runs as it is, with placeholders for what a file does not hold."""

import json
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.files.surfaces.compas_json import SUPPORT
from masonry.model.contact_groups import contact_group_name, contact_groups
from masonry.scene.schema import INVENTED

ASKED = "--section"
"""Where the section is from, if the user gave it."""
MATERIAL = """density = "1900 kg/m^3"
# young_modulus = "10 GPa"        # for kinematics "affine" and "tets"
# poisson_ratio = 0.2
"""
JOINT = """normal_stiffness = "80 GPa/m"
shear_stiffness = "35 GPa/m"
tensile_strength = "0.2 MPa"
cohesion = "0.3 MPa"
friction_angle = "40 deg"
fracture_energy_mode_1 = "10 N/m"
fracture_energy_mode_2 = "50 N/m"
"""
DRY_JOINT = """normal_stiffness = "30 GPa/m"
shear_stiffness = "12 GPa/m"
tan_friction_angle = 0.6
"""
STIFF = """law = "elastic"
normal_stiffness = "800 GPa/m"
shear_stiffness = "350 GPa/m"
"""
PRESS = """[[support]]                       # instead of a set: "z = 0 mm" (faces), "blocks at z = 0 mm", "units.z-"
on = "bottom"
fix = "all"

[drive]                           # the blocks at the top are pressed down
on = "top"
direction = "-z"
displacement = "0.1 mm"
steps = 2000

# [[traction]]                    # a pressure on outer faces
# on = "z = ... mm"
# stress = { z = "-0.5 MPa" }
"""
WEIGHT = """[[support]]                       # instead of a set: "z = 0 mm" (faces), "blocks at z = 0 mm", "units.z-"
on = "bottom"
fix = "all"

[gravity]
z = "-9.81 m/s^2"
"""
DRY_WEIGHT = f"""{WEIGHT}
[settle]
steps = 20000
"""


@dataclass(frozen=True)
class Written:
    """Origin of a scene as it states it: names of the source and of the file of blocks, where the section is from, and
    whether the joints are dry and weight is the only load; the blocks as text, where no file has them."""

    source: str
    blocks_file: str
    section_is: str
    is_dry: bool = False
    content: str = ""


def scene_text(specimen: Specimen, joints: Joints, how: Written) -> str:
    """TOML of a scene on these blocks: dry under their own weight, or with strength and pressed from above.

    Where blocks reach from bottom to top there is weight in either case.
    """
    contacts = contact_groups(specimen.blocks, joints)[0] or (_possible(specimen.blocks.groups[0]),)
    spans = np.intersect1d(specimen.sets["bottom"], specimen.sets["top"])
    has_weight = how.is_dry or len(spans) > 0
    lines = [
        f"title = {_quoted(how.source)}",
        'law = "friction"                  # dry joints' if how.is_dry else 'law = "exponential"',
        'kinematics = "rigid"',
        "",
        "[specimen]",
        'kind = "file"',
        f"content = '{how.content}'" if how.content else f"path = {_quoted(how.blocks_file)}",
        *(['contact_points = "vertex"         # at the edges of the joints, about which blocks turn'] * how.is_dry),
        f'section = "{specimen.section:.12g} m^2"   # the force at the drive over this area is the reported stress',
        "",
    ]
    for group in specimen.blocks.groups:
        lines += [f"[material.{_key(group)}]", MATERIAL]
    for name in contacts:
        stiff = name == "plate" or name.startswith("within_")
        lines += [f"[contact.{_key(name)}]", STIFF if stiff else DRY_JOINT if how.is_dry else JOINT]
    loading = DRY_WEIGHT if how.is_dry else WEIGHT if has_weight else PRESS
    if SUPPORT in specimen.sets:
        loading = loading.replace('on = "bottom"', f'on = "{SUPPORT}"', 1)
    return "\n".join([*lines, loading, *_assumptions(specimen, contacts, how, has_weight)]) + "\n"


def _assumptions(specimen: Specimen, contacts: Sequence[str], how: Written, has_weight: bool) -> list[str]:
    """Lines of the table that says what the file does not hold."""
    invented = [f"material.{group}" for group in specimen.blocks.groups]
    invented += [f"contact.{name}" for name in contacts]
    invented += ["law", *["support"] * (SUPPORT not in specimen.sets), "gravity" if has_weight else "drive"]
    lines = ["[assumptions]", *(f"{_quoted(key)} = {_quoted(INVENTED)}" for key in invented)]
    if specimen.joints is not None:
        widest = specimen.joints.gap.max(initial=0.0) * 1e3
        words = f"joints bridge gaps of up to {widest:.3g} mm, half way between blocks that only nearly meet"
        lines.append(f'"specimen.{"content" if how.content else "path"}" = {_quoted(words)}')
    if how.section_is != ASKED:
        lines.append(f'"specimen.section" = {_quoted(f"the import took {how.section_is}")}')
    return lines


def _possible(group: str) -> str:
    """The contacts that a lone block could have with one like it."""
    return contact_group_name(group, group, same_unit=False)


def _key(name: str) -> str:
    return name if name.isascii() and name.replace("_", "").replace("-", "").isalnum() else _quoted(name)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
