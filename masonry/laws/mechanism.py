"""How a contact answers: the softening mechanism, unless the law's own file brings its own functions."""

from numba.extending import overload

from masonry.laws import softening
from masonry.laws.dispatch import beside


def _of(shape_class: type, name: str):
    return beside(shape_class, name, getattr(softening, name))


def elastic_trial(shape, interface, memory, opening, tau_squared):
    """(sigma in Pa, True if the history does not change) under an opening (m) and elastic shear stress^2 (Pa2)."""
    return _of(type(shape), "elastic_trial")(shape, interface, memory, opening, tau_squared)


def return_mapping(shape, interface, memory, opening, total, tau):
    """Answer of a contact whose history changes; total slip (m), elastic shear stress before any return (Pa)."""
    return _of(type(shape), "return_mapping")(shape, interface, memory, opening, total, tau)


def stored_energy(shape, interface, memory, opening, tau_squared):
    """Recoverable energy per area (J/m2), from the state alone."""
    return _of(type(shape), "stored_energy")(shape, interface, memory, opening, tau_squared)


@overload(elastic_trial)
def _elastic_trial(shape, interface, memory, opening, tau_squared):
    return _of(shape.instance_class, "elastic_trial")


@overload(return_mapping)
def _return_mapping(shape, interface, memory, opening, total, tau):
    return _of(shape.instance_class, "return_mapping")


@overload(stored_energy)
def _stored_energy(shape, interface, memory, opening, tau_squared):
    return _of(shape.instance_class, "stored_energy")
