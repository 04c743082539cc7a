"""How a contact answers: the softening mechanism, unless the law's own file brings its own functions."""

from masonry.jit.extending import overload
from masonry.laws import softening
from masonry.laws.dispatch import beside


def _of(parameters_class: type, name: str):
    return beside(parameters_class, name, getattr(softening, name))


def elastic_trial(parameters, joint, history, opening, tau_squared):
    """(sigma in Pa, True if the history does not change) under an opening (m) and elastic shear stress^2 (Pa2)."""
    return _of(type(parameters), "elastic_trial")(parameters, joint, history, opening, tau_squared)


def return_mapping(parameters, joint, history, opening, total, tau):
    """StressUpdate of a contact whose history changes; total slip (m), elastic shear stress before any return (Pa)."""
    return _of(type(parameters), "return_mapping")(parameters, joint, history, opening, total, tau)


def stored_energy(parameters, joint, history, opening, tau_squared):
    """Recoverable energy per area (J/m2), from the state alone."""
    return _of(type(parameters), "stored_energy")(parameters, joint, history, opening, tau_squared)


@overload(elastic_trial, strict=False)
def _elastic_trial(parameters, joint, history, opening, tau_squared):
    return _of(parameters.instance_class, "elastic_trial")


@overload(return_mapping, strict=False)
def _return_mapping(parameters, joint, history, opening, total, tau):
    return _of(parameters.instance_class, "return_mapping")


@overload(stored_energy, strict=False)
def _stored_energy(parameters, joint, history, opening, tau_squared):
    return _of(parameters.instance_class, "stored_energy")
