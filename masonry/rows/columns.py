"""The columns of a curve and of the energy ledger, with the unit of each."""

from collections.abc import Iterable, Mapping

UNITS = {
    "step": "1",
    "time": "s",
    "displacement": "m",
    "stress": "Pa",
    "support_stress": "Pa",
    "force": "N",
    "external_work": "J",
    "elastic_blocks": "J",
    "elastic_contacts": "J",
    "fracture_mode_1": "J",
    "fracture_mode_2": "J",
    "friction": "J",
    "damping": "J",
    "kinetic": "J",
    "contact_work": "J",
    "imbalance": "J",
}
"""The columns of a history, with the unit of each; the columns of gauges, in m, come besides. `stress` is taken at the
drive, `support_stress` at the support, `force` is that of the drive;
`contact_work` is the trapezoid work that the contacts took up, `imbalance` what is left of the energy balance."""


LARGE_UNITS = {"rotor": "J", "dashpot": "J", "redetection": "J", "area": "J"}
"""Columns of large displacement besides: what free rotations, and blocks that deform, lost by the step's length; what
dashpots dissipated; what shear lost as contacts were detected anew; what pressed areas that went or shrank held, less
those that came or grew."""


DASHPOT = "dashpot"
"""The one of them that a run of small displacement has where it has dashpots in contacts."""
TILT = "tilt_of_gravity"
"""The column (rad) of a run whose gravity is turned."""
FACTOR = "load_factor"
"""The column (1) of a run whose load grows until it falls."""
OFF_BALANCE = "out_of_balance"
"""The column (1) of one that leads a gauge on behind the collapse: by how much the factor exceeds equilibrium, on
average since the row before, over the collapse factor; 0 at the rests before."""
EXCESS = "excess_force"
"""The column (N) of a run whose drive is paced by an accuracy: what of its force inertia and damping hold up, so that
it is not borne at rest."""
GROUND = {axis: f"ground_{axis}" for axis in "xyz"}
"""By axis: the column (m/s2) of the acceleration of the ground, where it moves."""
INPUT_ENERGY = "input_energy"
"""The column (J) of a run whose ground moves: the work since the settling of all but the dead loads."""
GRAVITY = 9.80665
"""m/s2, by which accelerations are told as shares of g."""
RATES = {"velocity": "m/s", "acceleration": "m/s2"}
"""Units of gauges that read no displacement, by what they read."""
CRUSHING = "crushing"
"""The column (J) of a run that models crushing."""
ELASTIC_BARS, PLASTIC_BARS = "elastic_bars", "plastic_bars"
"""Columns (J) of a run with bars: what they store, and what their yielding took."""
STORED_BY_ELEMENTS, TAKEN_BY_ELEMENTS = (ELASTIC_BARS,), (PLASTIC_BARS,)
"""Columns (J) of all kinds of elements: what they store, and what they take for good."""
ELEMENT_UNITS = dict.fromkeys((*STORED_BY_ELEMENTS, *TAKEN_BY_ELEMENTS), "J")
DISSIPATED = ("fracture_mode_1", "fracture_mode_2", "friction")
"""What cracks and slip dissipate."""


def dissipated_in(columns: Iterable[str]) -> tuple[str, ...]:
    """The columns of what cracks, slip and, where they are modelled, crushing and elements dissipate."""
    return (*DISSIPATED, *(column for column in (CRUSHING, *TAKEN_BY_ELEMENTS) if column in columns))


def stored_in(terms: Mapping[str, float]) -> float:
    """J that blocks, contacts and elements store, of the terms of a ledger."""
    of_elements = (terms.get(column, 0.0) for column in STORED_BY_ELEMENTS)
    return sum(of_elements, start=terms["elastic_blocks"] + terms["elastic_contacts"])


def gauges_of(columns: Iterable[str]) -> list[str]:
    """Those of some columns that are gauges."""
    others = {*UNITS, *LARGE_UNITS, *ELEMENT_UNITS, TILT, FACTOR, OFF_BALANCE, EXCESS, INPUT_ENERGY, CRUSHING}
    others |= set(GROUND.values())
    return [column for column in columns if column not in others]


def unit_of(column: str) -> str:
    """Of a column of a history; all that are not in UNITS are gauges, but for the tilt, the ground, the load factor and
    how far it is from equilibrium."""
    if column in GROUND.values():
        return "m/s2"
    return (
        {
            TILT: "rad",
            FACTOR: "1",
            OFF_BALANCE: "1",
            EXCESS: "N",
            INPUT_ENERGY: "J",
            CRUSHING: "J",
            **ELEMENT_UNITS,
        }.get(column)
        or UNITS.get(column)
        or LARGE_UNITS.get(column, "m")
    )
