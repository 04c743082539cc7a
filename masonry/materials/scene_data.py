"""Units of a scene: kinematics, divisions, heights, so that a contact table fits it."""

from collections.abc import Mapping
from typing import Any

from masonry.errors import SceneError
from masonry.materials.contact_data import LAWS, SOFTENING, ContactData
from masonry.scene import Scene

FIT = 1e-3
"""Share of a course by which its height in the scene may differ from that of a unit and a joint."""


def with_scene(known: Mapping[str, Any], scene: Scene, dashes: bool = False) -> dict[str, Any]:
    """The data of a user with those of the scene beside them. Raises SceneError where they do not agree."""
    data = ContactData(known, dashes)
    if getattr(scene.specimen, "mortar", None) is not None:
        raise SceneError(
            f"scene '{scene.name}': its mortar is made of blocks, which have a stiffness of their own; leave out "
            "specimen.mortar, or give unit_mortar by hand"
        )
    of_scene = {"kinematics": scene.kinematics_of("units"), "divisions": _divisions(scene, data)}
    for key, value in of_scene.items():
        if getattr(data, key) not in (None, value):
            raise SceneError(f"{data.name(key)} {getattr(data, key)}: scene '{scene.name}' has {value}")
    group = scene.contact.get(data.contact or "unit_unit")
    bonds = any(getattr(data, key) is not None for key in ("mortar", "cohesion", "triplets"))
    if group is not None and group.law in (LAWS if not bonds else SOFTENING) and not data.is_dry:
        of_scene["law"] = group.law
    material = scene.material.get("units")
    if material is not None and material.young_modulus is not None:
        of_scene["unit_modulus"] = f"{material.young_modulus!r} Pa"
    return {**of_scene, **_heights(scene, data), **known}


def _divisions(scene: Scene, data: ContactData) -> int:
    """Blocks in the height of a unit; one where no contacts are within units."""
    if "within_units" not in scene.contact:
        return 1
    if scene.specimen.has_cells:
        if data.divisions is None:
            raise SceneError(
                f"{data.name('divisions')}: missing; the units of scene '{scene.name}' are cells: give the height of a "
                "unit over that of a cell"
            )
        return int(data.divisions)
    divisions = getattr(scene.specimen, "divisions", None)
    return int(divisions[-1]) if divisions else 1


def _heights(scene: Scene, data: ContactData) -> dict[str, str]:
    """Of unit and joint, from the height of a course in the scene; what the user said must fit it."""
    course, joint = scene.specimen.course_height, getattr(scene.specimen, "joint_thickness", 0.0)
    if course is None:
        if data.unit_height is not None:
            return {}
        raise SceneError(
            f"{data.name('unit_height')}: missing; scene '{scene.name}' has no courses: give the size of a unit "
            "across its joints"
        )
    dry = data.is_dry
    thickness = 0.0 if dry else data.joint or joint or course - (data.unit_height or course)
    unit = data.unit_height or course - thickness
    if abs(unit + thickness - course) > FIT * course:
        raise SceneError(
            f"{data.name('unit_height')} and {data.name('joint')} make courses of {1e3 * (unit + thickness):g} mm; "
            f"those of scene '{scene.name}' are {1e3 * course:g} mm high"
        )
    return {"unit_height": f"{unit!r} m"} | ({"joint": f"{thickness!r} m"} if thickness > 0.0 else {})
