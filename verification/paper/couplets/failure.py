"""How a couplet with a bed of mortar fails: where it cracks, and in which mode."""

from verification.paper.couplets.checked import checked
from verification.paper.couplets.laws import CONFINEMENTS, words
from verification.paper.couplets.measures import Cracks, Interfaces, cracks, interfaces
from verification.paper.couplets.mortar import SIZES, known, name
from verification.paper.experiment import Claim, Done

LEAST, LED, UNEVEN = 0.05, 0.5, 0.2
"""Shares: of the section that is broken, to be a crack; of a crack at which tension leads, to be one of tension; of the
confinement, by which the stress on a joint scatters that is not uniform."""


def found(done: Done) -> dict[str, Cracks]:
    """Label -> cracks of every run of a size at a confinement."""
    labels = [name(size, c) for size in SIZES for c in known(done, size)]
    return {label: cracks(done[label]) for label in labels}


def claims(done: Done) -> list[Claim]:
    """Section 4 on Fig. 8."""
    all_of_them = found(done)
    even = {name(s, c): (interfaces(done[name(s, c)]), CONFINEMENTS[c]) for s in SIZES for c in known(done, s)}
    return [uneven(even), combined(all_of_them), tensile(all_of_them)]


def uneven(even: dict[str, tuple[Interfaces, float]]) -> Claim:
    """The normal stress along the interfaces at the peak."""
    return checked(
        "Uniform normal and shear stress along the bed joint is difficult to guarantee",
        "4",
        f"standard deviation of the normal stress on the interfaces at the peak > {UNEVEN:.0%} of the confinement",
        "deviation, share of the interfaces in tension, share softened: "
        + "; ".join(
            f"{label} {one.scatter / 1e6:.2f} MPa, {one.tension:.0%}, {one.softened:.0%}"
            for label, (one, _) in even.items()
        ),
        all(one.scatter > UNEVEN * confinement for one, confinement in even.values()),
        "it is uniform",
    )


def combined(all_of_them: dict[str, Cracks]) -> Claim:
    """Cracks along both interfaces, joined through the bed."""
    return checked(
        "The failure may occur at the interface, the mortar joint, or a combination of both",
        "4, Fig. 8",
        f"broken share of the section > {LEAST:.0%} at the interfaces and within the bed, in every run",
        "lower interface / upper / bed: "
        + "; ".join(f"{label} {words((c.lower, c.upper, c.bed), '.2f')}" for label, c in all_of_them.items()),
        all(c.lower + c.upper > LEAST and c.bed > LEAST for c in all_of_them.values()),
        "one of the two stays whole",
    )


def tensile(all_of_them: dict[str, Cracks]) -> Claim:
    """Tension leads within the bed."""
    return checked(
        "The meso-model captures tensile cracks in the mortar joint",
        "4",
        f"tension leads at more than {LED:.0%} of the broken area within the bed",
        "; ".join(f"{label} {c.bed_tension:.0%}" for label, c in all_of_them.items()),
        all(c.bed_tension > LED for c in all_of_them.values()),
        "shear leads",
    )
