"""The interface model of a scene: the same mesh, the same points, the same properties, and other equations' code."""

from typing import Any

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.model.contact_groups import contact_group_name
from masonry.scene.tables.contact_group import Contact
from verification.references.interface.crushing import Compression
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import solid
from verification.references.interface.model import InterfaceModel, model


def interface_model(assembly: Assembly) -> InterfaceModel:
    """Tier 1 of an assembly of tets, of one material; nothing is held, driven or loaded yet."""
    mesh, blocks = assembly.mesh, assembly.specimen.blocks
    assert mesh is not None and len(mesh.tets) > 0
    block = np.repeat(np.arange(blocks.count), np.diff(mesh.tet_start))
    material = next(iter(assembly.scene.material.values()))
    assert material.young_modulus is not None and material.poisson_ratio is not None

    def law(a: int, b: int) -> Law:
        names = blocks.groups[blocks.group[a]], blocks.groups[blocks.group[b]]
        return law_of(assembly.scene.contact[contact_group_name(*names, bool(blocks.unit[a] == blocks.unit[b]))])

    return model(solid(mesh.nodes, mesh.tets, block), material.young_modulus, material.poisson_ratio, law)


def law_of(contact: Contact) -> Law:
    """The joint that a scene's table describes."""
    if contact.law == "elastic":
        return Law("elastic", contact.normal_stiffness, contact.shear_stiffness)
    properties = {
        "fT": contact.tensile_strength,
        "c0": contact.cohesion,
        "tan0": contact.tan_friction,
        "c_res": contact.residual_cohesion,
        "tan_res": contact.tan_friction if contact.tan_residual_friction is None else contact.tan_residual_friction,
        "G_I": contact.fracture_energy_mode_1,
        "G_II": contact.fracture_energy_mode_2,
        "G_II_slope": contact.fracture_energy_mode_2_slope,
        "alpha": contact.exponent_tension,
        "beta": contact.exponent_shear,
    }
    numbers: dict[str, Any] = {name: float(value) for name, value in properties.items() if value is not None}
    numbers |= {"combined": contact.coupling == "combined", "compression": compression_of(contact)}
    return Law(contact.law, contact.normal_stiffness, contact.shear_stiffness, **numbers)


def compression_of(contact: Contact) -> Compression | None:
    """How it crushes; None where that is not modelled."""
    if contact.crushing is None or contact.compressive_strength is None:
        return None
    energy, kp, css = contact.fracture_energy_compression, contact.closing_at_peak, contact.cap_shear_factor
    if contact.crushing == "cap" and css is None:
        css = 9.0
    return Compression(contact.compressive_strength, np.inf if energy is None else energy, kp, css)
