"""How a contact answers: the softening mechanism, unless the law's own file brings its own functions."""

from masonry.jit.extending import overload, register_jitable
from masonry.laws import softening
from masonry.laws.law_dispatch import beside


def _of(parameters_class: type, name: str):
    return beside(parameters_class, name, getattr(softening, name))


def elastic_trial(parameters, joint, history, opening, tau_squared):
    """(sigma in Pa, True if the history does not change) under an opening (m) and elastic shear stress^2 (Pa2)."""
    return _of(type(parameters), "elastic_trial")(parameters, joint, history, opening, tau_squared)


def return_mapping(parameters, joint, history, opening, total, tau, before=None):
    """StressUpdate of a contact whose history changes; total slip (m), elastic shear stress before any return (Pa).

    before  Pa, the normal stress that acted until now, of contacts that dilate; a law of its own mechanism has no use
            for it
    """
    override = beside(type(parameters), "return_mapping")
    if override is not None:
        return override(parameters, joint, history, opening, total, tau)
    return softening.return_mapping(parameters, joint, history, opening, total, tau, before)


def stored_energy(parameters, joint, history, opening, tau_squared):
    """Recoverable energy per area (J/m2), from the state alone."""
    return _of(type(parameters), "stored_energy")(parameters, joint, history, opening, tau_squared)


@overload(elastic_trial, strict=False)
def _elastic_trial(parameters, joint, history, opening, tau_squared):
    return _of(parameters.instance_class, "elastic_trial")


@overload(return_mapping, strict=False)
def _return_mapping(parameters, joint, history, opening, total, tau, before=None):
    override = beside(parameters.instance_class, "return_mapping")
    if override is None:
        return softening.return_mapping
    override = register_jitable(override)
    return lambda parameters, joint, history, opening, total, tau, before=None: override(
        parameters, joint, history, opening, total, tau
    )


@overload(stored_energy, strict=False)
def _stored_energy(parameters, joint, history, opening, tau_squared):
    return _of(parameters.instance_class, "stored_energy")
