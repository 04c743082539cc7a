"""The energy ledger: stored terms from the state, works by the trapezoid of each force, dissipation from the laws.

Two independent sums meet here. `imbalance` closes external work, damping, kinetic energy, the blocks' elastic energy
and the trapezoid work into the contacts: round-off for a correct step. The contacts' trapezoid work less their stored
energy must equal what the laws booked as fracture and friction: equal only as far as the steps are small.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.configuration.parts.parts import parts_of
from masonry.elements.element import energies_of, stored_by
from masonry.model.model import Model
from masonry.rows.columns import CRUSHING, DISSIPATED, ELEMENT_UNITS, LARGE_UNITS


class Seen(NamedTuple):
    """Opening and slip (m), normal (tension above 0) and shear stress (Pa) of the contacts, (C,) each."""

    opening: np.ndarray
    slip: np.ndarray
    sigma: np.ndarray
    tau: np.ndarray


@dataclass(frozen=True)
class Observation:
    """State of contacts and blocks at one moment; stress (B, 6) Pa, energies in J; in large displacement the least det
    F, and a bound on the longest stretch of any line."""

    seen: Seen
    stress: np.ndarray
    elastic_contacts: float
    elastic_blocks: float
    least: float = 1.0
    longest: float = 1.0
    elastic_elements: float = 0.0

    @property
    def stored(self) -> float:
        """J, in all."""
        return self.elastic_blocks + self.elastic_contacts + self.elastic_elements


def observe(model: Model) -> Observation:
    """Look at every contact and block without changing them."""
    seen = np.zeros((4, len(model.group)))
    stored = configuration_of(model).look_at_contacts(seen)
    stress = np.zeros((model.blocks.count, 6))
    elastic, least, longest = 0.0, 1.0, 1.0
    for part in parts_of(model):
        if not part.deforms:
            continue
        of_part = np.zeros((len(part.blocks), 6))
        strain = part.strain(of_part)
        elastic, least, longest = elastic + strain.energy, min(least, strain.least), max(longest, strain.longest)
        stress[part.blocks] = of_part / model.layout.volume[part.blocks, None]
    return Observation(Seen(*seen), stress, stored, elastic, least, longest, stored_by(model.elements))


def kinetic(model: Model, before: list[np.ndarray]) -> float:
    """v(n-1/2) M v(n+1/2) / 2 (J), with which the balance closes to round-off; `before`: velocities a step earlier."""
    return sum(part.kinetic(old) for part, old in zip(parts_of(model), before, strict=True))


def velocities(model: Model) -> list[np.ndarray]:
    """Copies of the velocities of the bodies that are there; angular momenta in place of turns where blocks turn."""
    return [part.remembered() for part in parts_of(model)]


def present(model: Model) -> list[tuple[str, Any]]:
    """Kind and body of the bodies that are there."""
    return [(part.name, part.body) for part in parts_of(model)]


def works(model: Model) -> np.ndarray:
    """J so far: work of the contacts, the damping and all loads on the bodies; and, in large displacement, what free
    rotors lose and blocks that deform take up."""
    first, *others = (part.body.work.sum(axis=0) for part in parts_of(model))
    return np.asarray(sum(others, start=first))


def columns_of_joints(model: Model) -> tuple[str, ...]:
    """Columns that the ledger of a model has besides those of each run and those of its elements."""
    configuration = configuration_of(model)
    columns = {*energies_of(configuration.of_joints), *(("rotor",) if configuration.any_size else ())}
    return tuple(column for column in (*LARGE_UNITS, CRUSHING) if column in columns)


def ledger(model: Model, view: Observation, before: list[np.ndarray]) -> dict[str, float]:
    """All terms (J) at this moment, under the names of columns.UNITS and those of joints and elements. In large
    displacement the fourth of the works is what free rotors lost, and what went into blocks that deform: less what they
    store it is booked as lost."""
    done, configuration = works(model), configuration_of(model)
    contact_work, damping, external = -float(done[0]), -float(done[1]), float(done[2])
    dissipated = model.joints.area @ model.state.dissipated
    moving = kinetic(model, before)
    turning = {"rotor": float(done[3]) - view.elastic_blocks} if configuration.any_size else {}
    of_elements = energies_of((*configuration.of_joints, *model.elements))
    rubbed = of_elements.pop("friction", 0.0)
    for work in (one.work_from_outside() for one in model.elements):
        if work is not None:
            external, contact_work = external + work, contact_work + work
    return {
        "external_work": external,
        "elastic_blocks": view.elastic_blocks,
        "elastic_contacts": view.elastic_contacts,
        "fracture_mode_1": float(dissipated[0]),
        "fracture_mode_2": float(dissipated[1]),
        "friction": float(dissipated[2]) + rubbed,
        "damping": damping,
        "kinetic": moving,
        "contact_work": contact_work,
        "imbalance": external - damping - moving - view.elastic_blocks - contact_work - turning.get("rotor", 0.0),
        **turning,
        **of_elements,
    }


def open_in_contacts(terms: dict[str, float]) -> float:
    """Work that contacts took up (J) less all that is known of it: stored, dissipated, and booked at re-detection."""
    known = ("elastic_contacts", *DISSIPATED, CRUSHING, *ELEMENT_UNITS, "dashpot", "redetection", "area")
    return terms["contact_work"] - sum(terms.get(key, 0.0) for key in known)
