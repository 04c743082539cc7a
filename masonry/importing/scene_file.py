"""The scene that `masonry import` writes: it runs as it is, with placeholders for what a file does not hold."""

import json

import numpy as np

from geometry.blocks import Joints, Specimen
from masonry.model.contact_groups import contact_group_name, contact_groups
from masonry.scene.schema import INVENTED

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


def scene_text(specimen: Specimen, joints: Joints, source: str, blocks_file: str, section_is_made_up: bool) -> str:
    """TOML of a scene on these blocks. Where blocks reach from bottom to top there is weight instead of a drive."""
    contacts = contact_groups(specimen.blocks, joints)[0] or (_possible(specimen.blocks.groups[0]),)
    spans = np.intersect1d(specimen.sets["bottom"], specimen.sets["top"])
    loading = WEIGHT if len(spans) else PRESS
    invented = [f"material.{group}" for group in specimen.blocks.groups]
    invented += [f"contact.{name}" for name in contacts]
    invented += ["law", "support", "gravity" if len(spans) else "drive"]
    lines = [
        f"title = {_quoted(source)}",
        'law = "exponential"',
        'kinematics = "rigid"',
        "",
        "[specimen]",
        'kind = "file"',
        f"path = {_quoted(blocks_file)}",
        f'section = "{specimen.section:.12g} m^2"   # the force at the drive over this area is the reported stress',
        "",
    ]
    for group in specimen.blocks.groups:
        lines += [f"[material.{_key(group)}]", MATERIAL]
    for name in contacts:
        stiff = name == "plate" or name.startswith("within_")
        lines += [f"[contact.{_key(name)}]", STIFF if stiff else JOINT]
    lines += [loading, "[assumptions]"]
    lines += [f"{_quoted(key)} = {_quoted(INVENTED)}" for key in invented]
    if section_is_made_up:
        lines.append(f'"specimen.section" = {_quoted("the import took the area of the faces in the lowest plane")}')
    return "\n".join(lines) + "\n"


def _possible(group: str) -> str:
    """The contacts that a lone block could have with one like it."""
    return contact_group_name(group, group, same_unit=False)


def _key(name: str) -> str:
    return name if name.isascii() and name.replace("_", "").replace("-", "").isalnum() else _quoted(name)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
