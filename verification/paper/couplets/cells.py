"""Effect of the cells of a bed of mortar on a couplet: their springs, size, seed and stiffness; uneven stress."""

from verification.paper.couplets.laws import CONFINEMENTS, words
from verification.paper.couplets.measures import Interfaces, initial_stiffness, interfaces, spread, work_to
from verification.paper.couplets.mortar import HIGH, LOW, OF_BRICK, SEEDS, SEMI_RIGID, SIZES, known, name
from verification.paper.experiment import Claim, Done, claim
from verification.references.closed_forms import Joint

SIZE, RIGID, BED = 0.05, 0.05, 0.15
"""Tolerances: of peaks by size and seed of the cells, of stiff blocks, of a stiffness."""
UNEVEN = 0.2
"""Share of the confinement by which the stress on a joint scatters that is not uniform."""
LATE = 0.5e-3
"""A displacement (m) by which most has softened."""


def claims(done: Done) -> list[Claim]:
    """Sections 2, 4 and 8 on blocks, section 4 on uniform stress."""
    full = SEMI_RIGID.format(LOW) in done.runs
    even = {name(s, c): (interfaces(done[name(s, c)]), CONFINEMENTS[c]) for s in SIZES for c in known(done, s)}
    return [stiffness(done), *([sizes(done), seeds(done), stiff_blocks(done)] if full else []), uneven(even)]


def stiffness(done: Done) -> Claim:
    """Whether springs of E/t make the couplet as stiff as the two blocks of Fig. 6, which stand for the same test."""
    given = {
        size: initial_stiffness(done[name(size, c)].history.rows)
        for size, c in (("coarse", LOW), ("medium", HIGH))
        if name(size, c) in done.runs
    }
    alone = 2.9e9 / 2.4 / 0.015
    return claim("Contact stiffness is E/t and G/t; t is 4 mm for 100 blocks", "4, eq. (18)",
                 f"first slope within {BED:.0%} of ks of the two blocks, {Joint().ks / 1e9:.0f} GPa/m",
                 "; ".join(f"{size} {k / 1e9:.1f} GPa/m ({k / Joint().ks:.2f} of it)" for size, k in given.items())
                 + f"; G/15 mm of the mortar alone, {alone / 1e9:.1f} GPa/m, has no interfaces in it",
                 all(abs(k / Joint().ks - 1.0) <= BED for k in given.values()),
                 "another t would do; for 300 cells 2.49 mm is assumed")  # fmt: skip


def sizes(done: Done) -> Claim:
    """Coarse against medium."""
    gaps = [done.peak(name("medium", c)) / done.peak(name("coarse", c)) - 1.0 for c in CONFINEMENTS]
    work = [
        work_to(done[name("medium", c)].history.rows, LATE) / work_to(done[name("coarse", c)].history.rows, LATE) - 1.0
        for c in CONFINEMENTS
    ]
    return claim("Coarse and medium meso-models agree", "4, Fig. 7; 8, second conclusion",
                 f"peaks within {SIZE:.0%} of each other",
                 f"medium {words((100 * g for g in gaps), '+.1f')} %; work to 0.5 mm "
                 f"{words((100 * w for w in work), '+.0f')} %",
                 max(map(abs, gaps)) <= SIZE, "the size of the cells matters")  # fmt: skip


def seeds(done: Done) -> Claim:
    """How much chance there is in the cells."""
    peaks = {(s, c): [done.peak(name(s, c, seed)) for seed in SEEDS] for s in SIZES for c in (LOW, HIGH)}
    return claim("The randomly generated blocks stand for the mortar, whatever their seed", "2; 8, third conclusion",
                 f"peaks of seeds 1, 2 and 3 within {SIZE:.0%} of each other",
                 "; ".join(f"{s}, {c}: {words(p / 1e6 for p in v)} MPa ({spread(v):.1%})"
                     for (s, c), v in peaks.items()),
                 max(map(spread, peaks.values())) <= SIZE, "100 cells are two or three across the bed: "
                 "their edges decide how evenly the interfaces are loaded")  # fmt: skip


def stiff_blocks(done: Done) -> Claim:
    """Ten times the macro stiffness, against rigid blocks and the macro stiffness itself."""
    rigid = [done.peak(name("coarse", c)) for c in (LOW, HIGH)]
    changes = {
        word: [done.peak(label.format(c)) / r - 1.0 for c, r in zip((LOW, HIGH), rigid, strict=True)]
        for word, label in (("ten times", SEMI_RIGID), ("once", OF_BRICK))
    }
    return claim("Blocks ten times as stiff as the materials leave deformation to the discontinuities", "4",
                 f"peaks of semi-rigid blocks within {RIGID:.0%} of those of rigid ones, coarse, 0.1 and 1.0 MPa",
                 "; ".join(f"{word} the stiffness {words((100 * v for v in values), '+.1f')} %"
                     for word, values in changes.items()),
                 max(map(abs, changes["ten times"])) <= RIGID,
                 "the deformation of the blocks has an effect")  # fmt: skip


def uneven(even: dict[str, tuple[Interfaces, float]]) -> Claim:
    """The normal stress along the interfaces at the peak."""
    return claim("Uniform normal and shear stress along the bed joint is difficult to guarantee", "4",
                 f"standard deviation of the normal stress on the interfaces at the peak > {UNEVEN:.0%} of the "
                 "confinement",
                 "deviation, share of the interfaces in tension, share softened: "
                 + "; ".join(f"{label} {pattern.scatter / 1e6:.2f} MPa, {pattern.tension:.0%}, {pattern.softened:.0%}"
                     for label, (pattern, _) in even.items()),
                 all(pattern.scatter > UNEVEN * confinement for pattern, confinement in even.values()),
                 "it is uniform")  # fmt: skip
