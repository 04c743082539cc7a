"""Section 6: does the size of the blocks matter? 218, 335 and 540 cells, five seeds each (Figs. 15 and 16)."""

from collections.abc import Iterator

from verification.html import page
from verification.paper import pictures
from verification.paper.experiment import Done, Experiment, Run, Section
from verification.paper.sizes.claims import claims
from verification.paper.sizes.families import BRITTLE, FIRST, HELD, SECOND, SIZES, Cells, Family, gathered
from verification.paper.sizes.pictures import mean_curves, peaks_figure, spread_table
from verification.paper.walls.common import CLAMPED, MODE_1, MODE_2, quick_enough

SEEDS = 5
SEED = "specimen.cells.seed"
INTRODUCTION = (
    "The paper shows one division into cells for each size. Ours are random too, so that a difference between two "
    "sizes "
    "can be chance: each size was divided five times, and the peaks are taken apart into what seeds do within a size "
    "and what sizes do beyond that (analysis of variance). Joint stiffness is 167, 200 and 250 GPa/m, as in the paper."
)

SUDDEN = (
    "Two families break at once somewhere, and no loading is slow enough for that. With the brittle law the whole "
    "crack "
    "runs. With plates that do not turn, two half cracks become one: the ends of one such wall differ by 3.7, 2.6 and "
    "1.8 % of the peak for that moment at accuracies of 1, 0.5 and 0.25 %. Their ends are compared before the peak."
)


def seeds(quick: bool) -> range:
    """Of the divisions into cells."""
    return range(1, 2 if quick else SEEDS + 1)


def families(quick: bool) -> Iterator[Family]:
    """Families of runs for every size and seed; plates that do not turn and the brittle law only in full."""
    yield Family(FIRST, MODE_1, pace_check=True)
    yield Family(SECOND, MODE_2, pace_check=True)
    if not quick:
        yield Family(HELD, MODE_2, CLAMPED, pace_check=True, sudden="two half cracks become one at once")
        brittle = {"law": "brittle", "drive.displacement": "0.03 mm"}
        yield Family(BRITTLE, MODE_2, brittle, pace_check=True, sudden="a brittle crack runs at once")


def runs(quick: bool) -> dict[str, Run]:
    """Every family with every size and seed."""
    made = {
        cells.label(family): Run(
            f"{family.scene}-{cells.size}", {**family.settings, SEED: cells.seed}, family.pace_check, family.sudden
        )
        for family in families(quick)
        for cells in divisions(quick)
    }
    return quick_enough(made, quick)


def divisions(quick: bool) -> list[Cells]:
    """Every size with every seed."""
    return [Cells(size, seed) for size in SIZES for seed in seeds(quick)]


def show(done: Done) -> Section:
    """Curves of one seed and of the mean, peaks by size and seed, crack patterns."""
    selected = list(families(done.quick))
    found = {family.name: gathered(done, family, divisions(done.quick)) for family in selected}
    panels = {
        f"Fig. 15{part}: {name}": mean_curves(found[name]) for part, name in zip("ab", (FIRST, SECOND), strict=True)
    }
    seen = {c.label(f): done[c.label(f)] for f in selected[:2] for c in (Cells(SIZES[0], 1), Cells(SIZES[-1], 1))}
    parts = [
        page.paragraph(INTRODUCTION),
        page.picture(pictures.curves(panels), "Fig. 15, ours: means of all seeds."),
        page.picture(pictures.cracks(seen), "Fig. 16, ours: coarse and fine cells, seed 1, at the end.", pixels=True),
    ]
    if not done.quick:
        many = {f"seed {c.seed}": done[c.label(selected[1])] for c in divisions(False) if c.size == SIZES[0]}
        caption = "Peaks by size and seed, and where cracks run in failure mode 2. Bars: means of the seeds."
        parts += [
            page.picture(peaks_figure(found), caption),
            page.picture(pictures.cracks(many, columns=3), "Failure mode 2, 218 cells: five divisions.", pixels=True),
            *spread_table(found),
            page.paragraph(SUDDEN, "note"),
        ]
    return Section(parts, claims(found, done.quick))


EXPERIMENT = Experiment("block-size", "Size of the blocks (Figs. 15 and 16)", 40, runs, show)
