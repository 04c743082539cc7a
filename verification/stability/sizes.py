"""Sizes: a speck beside a boulder, slivers, and densities of feathers and of stars."""

from verification.stability.cells import Grid, MapCell
from verification.stability.references import sheared, torn
from verification.stability.scenes import CHAIN, PAIR, Knobs, chain_of, pair_of

PULLED: Knobs = {"drive.steps": 12000, "solver.rows": 200}


def ratios(full: bool) -> Grid:
    """A cube of 1 m and one of down to 1e-6 m."""
    edges = [10.0**-k for k in range(7)] if full else [1.0, 1e-6]
    arranged = {"small on large": lambda a: (1.0, a), "large on small": lambda a: (a, 1.0), "both": lambda a: (a, a)}
    cells = {
        (row, f"{1.0 / edge:g}"): MapCell(PAIR, {"drive.steps": 5000, **pair_of(*place(edge))}, sheared, ("OK",))
        for row, place in arranged.items()
        for edge in edges
    }
    note = "Row 'both': two cubes as small as that. Lengths of the joint go with the smaller cube."
    return Grid("Size of the blocks", "blocks", "1 m over the edge of the smaller cube", cells, note=note)


def slivers(full: bool) -> Grid:
    """A slab between two cubes, as thin as a thousandth of its length, by kinematics."""
    thin = (1.0, 10.0, 100.0, 1000.0) if full else (1000.0,)
    cells = {}
    for kinematics in ("rigid", "affine", "tets") if full else ("rigid",):
        for ratio in thin:
            knobs = {**PULLED, **chain_of((0.1, 0.1 / ratio, 0.1)), "material.units.poisson_ratio": 0.0}
            knobs |= {"kinematics": kinematics, "specimen.mesh": "fan"}
            cells[kinematics, f"{ratio:g}"] = MapCell(CHAIN, knobs, torn)
    note = "Poisson's ratio is 0, so that the stuck ends do not disturb the uniform stress."
    return Grid("Slivers", "units", "length over thickness", cells, note=note)


def densities(full: bool) -> Grid:
    """The density of a chain in tension: it must not matter where inertia does not."""
    values = [10.0**k for k in range(-3, 6)] if full else [1e-3, 1e5]
    cells = {}
    for masses in ("scaled", "real"):
        for density in values:
            knobs = {**PULLED, **chain_of((0.1,) * 6), "solver.masses": masses}
            cells[masses, f"{density:g}"] = MapCell(
                CHAIN, knobs | {"material.units.density": f"{density:g} kg/m^3"}, torn
            )
    return Grid("Density", "masses", "density [kg/m3]", cells)


GRIDS = (ratios, slivers, densities)
