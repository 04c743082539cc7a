"""What a user should know of the numbers given for contacts: where one of them does not do what it says."""

from math import inf

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.laws.factory import properties_of
from masonry.laws.state import Interface
from masonry.monitors.stability import smallest_block
from masonry.scene.tables.contact import Contact
from masonry.scene.tables.loading import Drive


def contact_remarks(assembly: Assembly) -> list[str]:
    """One line for each number that is cut, or that nothing can come of in this specimen."""
    model, found = assembly.model, []
    for name, interface in zip(model.group_names, model.groups.properties, strict=True):
        given = assembly.scene.contact[name]
        reads = "tensile_strength" in properties_of(given.law)
        if reads and interface.tensile_strength is not None and np.ndim(interface.tensile_strength) == 0:
            found += _of_tension(name, given, interface, smallest_block(model))
        if interface.tan_dilation is not None:
            found += _of_dilation(name, given, interface, way_of(assembly.scene.drive))
    return found


def _of_tension(name: str, given: Contact, interface: Interface, block: float) -> list[str]:
    """Tensile strength beyond the apex of the Coulomb line, or so low that no opening takes the cohesion."""
    wanted, has = given.tensile_strength or 0.0, float(interface.tensile_strength or 0.0)
    where = f"contact.{name}.tensile_strength"
    if wanted > 0.0 and has == 0.0 and given.cohesion:
        return [f"{where} = {wanted:g} Pa is less than 1e-5 of the cohesion of {given.cohesion:g} Pa: it is taken as 0"]
    if has < wanted:
        return [
            f"{where} = {wanted:g} Pa is beyond the apex of the Coulomb line, cohesion / tan(friction angle) = "
            f"{has:.6g} Pa, where a slip meets no resistance: tension is cut there"
        ]
    if has > 0.0 and (given.fracture_energy_mode_1 or 0.0) / has > block:
        return [
            f"{where}: at {has:g} Pa the fracture energy of mode I keeps the joint together over an opening of "
            f"{(given.fracture_energy_mode_1 or 0.0) / has:.3g} m, more than a block: lower that energy too, or take "
            "0 Pa for a joint that comes apart at once"
        ]
    return []


def _of_dilation(name: str, given: Contact, interface: Interface, way: float) -> list[str]:
    """A dilation that does not end within the way of the drive, though no end was given."""
    end = float(np.max(interface.dilation_cutoff)) if interface.dilation_cutoff is not None else inf
    if given.dilation_cutoff is not None or end <= way:
        return []
    return [
        f"contact.{name}: dilation does not end within the drive's {1e3 * way:.3g} mm: by its fracture energy the "
        f"cohesion is gone at a slip of {1e3 * end:.3g} mm only; give dilation_cutoff, or less fracture energy"
    ]


def way_of(drive: Drive | None) -> float:
    """m, the whole way of a drive, to and fro; without one nothing is known, and all is within it."""
    return inf if drive is None else float(np.abs(np.diff(drive.turns, prepend=0.0)).sum())
