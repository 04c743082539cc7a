"""Walls that laboratories pushed, beside the same walls computed from their tables: no number is fitted to a force."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from masonry.scene import load
from masonry.sweeps import engine
from masonry.sweeps.job import Job
from verification.html import figures, page

ORDER = 75
FOLDER = Path("results") / "measured-walls"
TWINS, FLEXURE, SHEAR = 0.09, 0.08, 0.20
"""By how much two walls of one test differ; what is sought of walls that bend, and of those that crack."""
QUICK = ("SW0.1", "SW0.2")
Settings = Mapping[str, Any]


class MeasuredWall(NamedTuple):
    """A wall of the tables: the scene and what is set in it, forces (kN) measured to and fro, how it failed, the drift
    up to which it is pushed, and what no table gives."""

    name: str
    scene: str
    settings: Settings
    measured: tuple[float, ...]
    failure: str
    assumed: str

    @property
    def mean(self) -> float:
        """Of those measured, kN."""
        return float(np.mean(self.measured))

    @property
    def sought(self) -> float:
        """Share by which the computed force may differ from the mean of those measured."""
        return FLEXURE if self.failure == "flexure" else SHEAR


def flexure(pressure: str) -> Settings:
    """COMP2: the packaged wall under another pressure."""
    return {"confinement": pressure}


def of_bricks(
    size: tuple[float, float, float], pressure: str, strength: float, modulus: float, joint: tuple[float, float]
) -> Settings:
    """A wall of bricks of 250 x 55 mm in joints of 10 mm, that crack across their middle: `shear-wall-size` with other
    numbers. size: height, length and thickness (m); strength, modulus (MPa); joint: cohesion (MPa), friction."""
    (height, length, thickness), (cohesion, friction) = size, joint
    courses, units = round(height / 0.065), round(length / 0.26)
    stiffness = 1e-3 * modulus * courses / height  # GPa/m: a course deforms in its joint
    joints = {
        "normal_stiffness": f"{stiffness:.4g} GPa/m",
        "shear_stiffness": f"{0.4 * stiffness:.4g} GPa/m",
        "tensile_strength": f"{2.0 / 3.0 * cohesion:.3g} MPa",
        "cohesion": f"{cohesion} MPa",
        "tan_friction_angle": friction,
        "compressive_strength": f"{strength} MPa",
        "fracture_energy_compression": f"{1.6 * strength:.4g} N/mm",
    }
    units_crack = {"tensile_strength": f"{0.1 * strength:.3g} MPa", "cohesion": f"{0.14 * strength:.3g} MPa"}
    return {
        "confinement": pressure,
        "specimen.courses": courses,
        "specimen.units_per_course": units,
        "specimen.unit_length": f"{1e3 * length / units - 10.0:.5g} mm",
        "specimen.unit_height": f"{1e3 * height / courses - 10.0:.5g} mm",
        "specimen.thickness": f"{thickness} m",
        "specimen.points_per_edge": {"x": 6, "y": 2, "z": 3},
        **{f"contact.{group}.{key}": value for group in ("unit_unit", "plate") for key, value in joints.items()},
        **{f"contact.within_units.{key}": value for key, value in units_crack.items()},
        "material.units.density": "18 kN/m^3",
        "material.plates.density": "1 kg/m^3",
        "gravity": {"z": "-9.81 m/s^2"},
        "settle.steps": 20000,
        "drive.displacement": f"{5.0 * height:.3g} mm",
    }


ISP, MI = (0.23, 0.58), (0.21, 0.81)
OF_JOINTS = "tensile strength of joints, fracture energies, shear stiffness"
OF_UNITS = f"{OF_JOINTS}, strength of units (a tenth of that of the masonry), energy of crushing, both ends fixed"
UNBALANCED = "beyond statics"
ABOVE = (
    "; a load that stays can balance {} kN, (N + W/2) L/H, whatever the wall bears: the one of the test must have grown"
)
WALLS = (
    MeasuredWall("COMP2_1", "shear-wall-flexure", {}, (59.1, 58.4), "flexure", OF_JOINTS),
    MeasuredWall("COMP2_3", "shear-wall-flexure", flexure("0.86 MPa"), (92.6, 92.6), "flexure", OF_JOINTS),
    MeasuredWall("COMP2_2", "shear-wall-flexure", flexure("1.20 MPa"), (120.0, 122.7), "flexure", OF_JOINTS),
    MeasuredWall(
        *("ISP3", "shear-wall-size", of_bricks((2.0, 1.0, 0.25), "0.6 MPa", 6.2, 3000.0, ISP), (71.9, 72.2)),
        *("flexure", f"E (3 GPa); {OF_UNITS}; 0.6 MPa, where the table's 0.8 contradicts itself"),
    ),
    MeasuredWall(
        *("ISP1", "shear-wall-size", of_bricks((1.35, 1.0, 0.25), "0.6 MPa", 6.2, 3000.0, ISP), (81.4, 84.2)),
        *("shear", f"E (3 GPa); {OF_UNITS}"),
    ),
    *(
        MeasuredWall(
            *(name, "shear-wall-size", of_bricks((height, 1.5, 0.38), pressure, 7.92, 2991.0, MI), measured),
            *(failure, f"{OF_UNITS}{more}"),
        )
        for name, height, pressure, measured, failure, more in (
            ("MI1", 2.0, "1.2 MPa", (270.0, 260.0), "shear", ""),
            ("MI2", 2.0, "0.4 MPa", (242.0, 227.0), UNBALANCED, ABOVE.format(179)),
            ("MI3", 3.0, "1.2 MPa", (190.0, 164.0), "shear", ""),
            ("MI4", 3.0, "0.4 MPa", (169.0, 154.0), UNBALANCED, ABOVE.format(122)),
        )
    ),
    MeasuredWall("SW0.1", "shear-wall-size", {}, (107.5, 99.4), "shear", OF_UNITS),
    MeasuredWall("SW0.2", "shear-wall-size", {"confinement": "1.408 MPa"}, (129.0, 137.0), "shear", OF_UNITS),
    MeasuredWall("WS100", "wall-ws100", {}, (36.8,), "flexure", "stiffness of joints: fitted to the first millimetre"),
)
STIFFNESS, STRENGTH, UNITS, POINTS = "joint stiffness", "strength in compression", "strength of units", "points"
PARAMETERS = {
    STIFFNESS: "halved, doubled",
    STRENGTH: "20 % less, 20 % more",
    UNITS: "halved, doubled",
    POINTS: "along joints: halved",
}


def variations(wall: MeasuredWall) -> dict[str, list[Settings]]:
    """By parameter, what is set in the scene of a wall besides to vary it."""
    scene = load(wall.scene, wall.settings)
    groups: list[str] = [name for name in ("unit_unit", "plate") if name in scene.contact]
    varied: dict[str, list[Settings]] = {
        STIFFNESS: [_times(wall, groups, ("normal_stiffness", "shear_stiffness"), factor) for factor in (0.5, 2.0)]
    }
    if scene.contact["unit_unit"].crushing is not None:
        varied[STRENGTH] = [_times(wall, groups, ("compressive_strength",), factor) for factor in (0.8, 1.2)]
    else:
        cut_off = {"crushing": "cut-off", "compressive_strength": "11 MPa"}
        varied[STRENGTH] = [{f"contact.{group}.{key}": value for group in groups for key, value in cut_off.items()}]
    if "within_units" in scene.contact:
        strengths = "tensile_strength", "cohesion"
        varied[UNITS] = [_times(wall, ["within_units"], strengths, factor) for factor in (0.5, 2.0)]
    if scene.is_large:
        varied[POINTS] = [{"specimen.patch_points_per_edge": 4}]
    elif (points := scene.specimen.points_per_edge) is not None:
        x = int(points[0])
        varied[POINTS] = [{"specimen.points_per_edge": {"x": max(x // 2, 2), "y": 2, "z": 2}}]
    return varied


def _times(wall: MeasuredWall, groups: Sequence[str], keys: tuple[str, ...], factor: float) -> Settings:
    """Some numbers of contact groups, times a factor (SI)."""
    scene, units = load(wall.scene, wall.settings), {"stiffness": "Pa/m"}
    return {
        f"contact.{group}.{key}": f"{factor * getattr(scene.contact[group], key)!r} "
        f"{units.get(key.rpartition('_')[2], 'Pa')}"
        for group in groups
        for key in keys
    }


class WallForces(NamedTuple):
    """Results of a wall: the largest force (kN), that of each variation by parameter, and why a run ended early."""

    peak: float
    varied: dict[str, list[float]]
    stopped: str

    def changes(self, parameter: str) -> list[float]:
        """Of the largest force, as shares; none where the parameter is not varied."""
        return [peak / self.peak - 1.0 for peak in self.varied.get(parameter, [])]

    @property
    def reach(self) -> tuple[float, float]:
        """kN, the least and the most of all variations."""
        peaks = [self.peak, *(peak for peaks in self.varied.values() for peak in peaks)]
        return min(peaks), max(peaks)


def forces_of(walls: Sequence[MeasuredWall], folder: Path, vary: bool, tell: Callable[[str], None]) -> list[WallForces]:
    """All walls by one call of the sweep engine, which keeps what was run before in a folder."""
    jobs, places = [], []
    for number, wall in enumerate(walls):
        jobs.append(Job(wall.scene, wall.settings, wall.name))
        places.append((number, "", 0))
        for parameter, settings in (variations(wall) if vary else {}).items():
            jobs += [Job(wall.scene, {**wall.settings, **s}, f"{wall.name}, {parameter}") for s in settings]
            places += [(number, parameter, k) for k in range(len(settings))]
    rows = dict(zip(places, engine.run(jobs, folder, tell=tell), strict=True))
    peaks = {place: 1e-3 * float(row["peak_force_n"]) for place, row in rows.items()}
    return [
        WallForces(
            peaks[number, "", 0],
            {p: [v for (n, q, _), v in peaks.items() if (n, q) == (number, p)] for p in PARAMETERS if vary},
            "" if rows[number, "", 0]["status"] == "OK" else str(rows[number, "", 0]["reason"]),
        )
        for number in range(len(walls))
    ]


def chapter(tell: Callable[[str], None], quick: bool = False, folder: Path = FOLDER) -> page.Chapter:
    """A table of all walls, a picture of their forces, and one of what each parameter moves; quick: two walls alone."""
    made = page.Chapter("Measured walls")
    walls = [wall for wall in WALLS if not quick or wall.name in QUICK]
    results = forces_of(walls, folder, not quick, tell)
    made.add(INTRODUCTION, page.table(HEADER, [_row(*both) for both in zip(walls, results, strict=True)]))
    if not quick:
        made.add(*_pictures(walls, results))
    for wall, result in zip(walls, results, strict=True):
        made.records.append(
            {
                **{"case": wall.name, "quantity": "largest force", "unit": "kN", "kind_of_reference": "measured"},
                **{"value": result.peak, "reference": wall.mean, "error": result.peak / wall.mean - 1.0},
                "changes": {parameter: result.changes(parameter) for parameter in result.varied},
            }
        )
    for failure in dict.fromkeys(wall.failure for wall in walls if wall.failure != UNBALANCED):
        made.judge(f"Measured walls, {failure}", *_verdict(failure, walls, results))
    return made


def _verdict(failure: str, walls: Sequence[MeasuredWall], results: Sequence[WallForces]) -> tuple[str, str]:
    errors = {w.name: r.peak / w.mean - 1.0 for w, r in zip(walls, results, strict=True) if w.failure == failure}
    sought = FLEXURE if failure == "flexure" else SHEAR
    within, worst = (
        [name for name in errors if abs(errors[name]) <= sought],
        max(errors, key=lambda name: abs(errors[name])),
    )
    sentence = (
        f"{len(within)} of {len(errors)} walls are within {page.percent(sought)} of the force measured, to which "
        f"nothing is fitted; {worst} is off most, by {errors[worst]:+.0%}. "
        f"Twins of one test differ by {page.percent(TWINS)}."
    )
    return "ok" if len(within) == len(errors) else "warn", sentence


def _row(wall: MeasuredWall, result: WallForces) -> list[Any]:
    error, (minimum, maximum) = result.peak / wall.mean - 1.0, result.reach
    return [
        wall.name,
        wall.failure,
        ", ".join(f"{force:g}" for force in wall.measured),
        f"{result.peak:.1f}",
        page.judged(f"{error:+.1%}", "none" if wall.failure == UNBALANCED else _kind(error, wall)),
        f"{minimum:.1f} to {maximum:.1f}" if result.varied else "-",
        page.TableCell(f"{wall.assumed}{'; ' if result.stopped else ''}{page.short(result.stopped)}", "text"),
    ]


def _kind(error: float, wall: MeasuredWall) -> str:
    return "ok" if abs(error) <= wall.sought else "warn"


def _pictures(walls: Sequence[MeasuredWall], results: Sequence[WallForces]) -> list[str]:
    """Forces with their bars; what each parameter moves."""
    figure, axes = figures.sheet(1, 1, (10.0, 4.0))
    ax, place = axes[0, 0], np.arange(len(walls))
    mean = np.array([wall.mean for wall in walls])
    peak = np.array([result.peak for result in results]) / mean
    bars = np.array([result.reach for result in results]).T / mean
    spread = np.array([(min(wall.measured), max(wall.measured)) for wall in walls]).T / mean
    ax.bar(place, peak, 0.55, color="#4a90c2", label="computed; bar: all variations")
    ax.errorbar(place, peak, [peak - bars[0], bars[1] - peak], fmt="none", ecolor="0.2", capsize=4)
    ax.vlines(place + 0.36, *spread, color="#b5432a", linewidth=4.0, label="measured, to and fro")
    ax.axhspan(1.0 - TWINS, 1.0 + TWINS, color="0.9", zorder=0, label=f"twins of one test: {TWINS:.0%}")
    ax.set_xticks(place, [wall.name for wall in walls], fontsize=8)
    ax.set_ylabel("largest force over the mean measured")
    ax.legend(frameon=False, fontsize=8, loc="upper left")
    tornado = [
        (wall.name, [[100.0 * change for change in result.changes(p)] or [0.0] for p in PARAMETERS])
        for wall, result in zip(walls, results, strict=True)
    ]
    titles = [f"{parameter}\n{words}" for parameter, words in PARAMETERS.items()]
    return [
        page.picture(figure, "Largest forces of walls, over the mean of those measured."),
        page.picture(figures.tornado(tornado, titles), "Change of the largest force, wall by wall."),
    ]


HEADER = ["wall", "failure", "measured +, - kN", "computed kN", "off", "all variations, kN", "what no table gives"]
INTRODUCTION = (
    "Eleven walls of the EPFL database of modern masonry walls, kept level at their top (Graziotti et al. 2016 and the "
    "sources named there), and a dry one that rocks (Vasconcelos 2005, StoneMasonryDatabase of EPFL). Size, strength "
    "in compression, modulus, cohesion, friction and pressure are those of the tables; what these do not give is "
    "named, and was chosen once for all walls. Each wall is run again with the stiffness of its joints halved and "
    "doubled, with a fifth less and more strength in compression (the dry wall: with a cut-off at 11 MPa), with units "
    "half and twice as strong, and with half the contact points along its joints (the dry wall: four along the edges "
    "of patches)."
)
