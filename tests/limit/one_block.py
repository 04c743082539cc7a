"""A scene of one block on ground that is held, and what may be added to it."""

SIDEWAYS = {"limit": {"pattern": "weight", "direction": "x"}}


def block(more: str, law: str = 'law = "friction"', size: str = '["0.5 m", "0.3 m", "1 m"]') -> str:
    """A block of 300 kg (unless its size is another) on one that is held."""
    return f"""
[specimen]
kind = "boxes"
section = "1 m^2"
contact_points = "vertex"
box = [
  {{name = "ground", origin = ["-1 m", "0 m", "-1 m"], size = ["3 m", "0.3 m", "1 m"], unit = 0}},
  {{name = "block", origin = ["0 m", "0 m", "0 m"], size = {size}, unit = 1}},
]
[material.units]
density = "2000 kg/m^3"
[contact.unit_unit]
{law}
normal_stiffness = "30 GPa/m"
shear_stiffness = "12 GPa/m"
tan_friction_angle = 0.7
[[support]]
on = "ground"
fix = "all"
[gravity]
z = "-10 m/s^2"
{more}
"""


DRIVE = """[drive]
on = "block"
direction = "x"
displacement = "1 mm"
"""
STRONG = """law = "linear"
tensile_strength = "4 kPa"
cohesion = "100 kPa"
fracture_energy_mode_1 = "10 N/m"
fracture_energy_mode_2 = "100 N/m"
"""
