"""The claims on fracture energies: what they do to the curve past the peak, and to the crack."""

from collections.abc import Mapping

import numpy as np

from masonry.laboratory.result import Result
from masonry.pictures.style import MEGA, MILLI
from verification.html.page import percent
from verification.paper.experiment import Claim, claim
from verification.paper.walls.common import mpa, where
from verification.paper.walls.crack_path import crack_path
from verification.paper.walls.curve_shape import apart, energy_per_section, fall_to, steepest_fall, tail
from verification.paper.walls.straight_crack import STRAIGHT

Series = Mapping[float, Result]
Both = Mapping[str, Series]
"""GI and GII -> factor -> result."""
WINDOW, SMOOTH = 5e-6, 0.10
"""m, and the largest share of the peak by which a smooth curve falls within it. The tension law of the shipped joints
falls by 10 % within 5 um, and half of what they carry at the peak is shear, which falls by 5 %."""
ROLE, DRASTIC = 0.1, 2.0
RESIDUAL = 0.02
"""A higher residual is one by more than this share, well above what half the loading error moves it by."""


def first_mode_claims(walls: Mapping[str, Both]) -> list[Claim]:
    """Failure mode 1, for each way of holding the plates, the shipped one first: the joints' energies."""
    return [role_claim(walls), smooth_claim(walls)]


def role_claim(walls: Mapping[str, Both]) -> Claim:
    """Both energies change the curve."""
    every = [(f"{hold}, {kind}", series) for hold, both in walls.items() for kind, series in both.items()]
    moved = {name: apart(series[4], series[0.5]) for name, series in every}
    tops = [f"{mpa(series[0.5]):.3f} to {mpa(series[4]):.3f} MPa" for _, series in every]
    return claim("Tensile and shear fracture energies of the interface have an important role on the macro behaviour",
                 "6, Fig. 17",
                 f"mode 1: the curves of half and of four times GI, and GII, are > {percent(ROLE)} of the peak apart "
                 "on average",
                 f"{'; '.join(f'{name}: {percent(value)}' for name, value in moved.items())}; peaks: {', '.join(tops)}",
                 min(moved.values()) > ROLE, "one of them hardly matters")  # fmt: skip


def smooth_claim(walls: Mapping[str, Both]) -> Claim:
    """No late drop at higher energies, with the plates as shipped; how it is with others stands beside it."""
    told = {hold: _falls(both) for hold, both in walls.items()}
    shipped, *others = told
    worst = {hold: max(fall for name, fall in told[hold].items() if not name.endswith("x 1")) for hold in told}
    return claim("Smooth convergence to residual stresses for higher GI and GII", "6, Fig. 17",
                 f"mode 1, {shipped}, energies x 2 and x 4: no fall of > {percent(SMOOTH)} of the peak within "
                 f"{WINDOW * 1e6:g} um after the peak",
                 "; ".join(f"{name}: {percent(fall)}" for name, fall in told[shipped].items())
                 + "".join(f". {hold}: up to {percent(worst[hold])}, one half of the wall parts first"
                     for hold in others),
                 worst[shipped] < SMOOTH, "the stress falls once more, late")  # fmt: skip


def _falls(both: Both) -> dict[str, float]:
    return {f"{kind} x {f:g}": steepest_fall(s[f], WINDOW) for kind, s in both.items() for f in (1, 2, 4)}


def second_mode_claims(walls: Mapping[str, Both]) -> list[Claim]:
    """Failure mode 2, for each division of the units: the units' energies."""
    cells = {name: both for name, both in walls.items() if name != "grid"}
    patterns = [pattern_claim(name, both["GI"]) for name, both in cells.items()]
    return [drastic_claim(walls), residual_claim(walls), *patterns, tension_claim(cells)]


def drastic_claim(walls: Mapping[str, Both]) -> Claim:
    """Twice the tensile energy of the units, beside twice their shear energy: the paper calls the first drastic."""
    moved = {name: [apart(both[kind][2], both[kind][1]) for kind in ("GI", "GII")] for name, both in walls.items()}
    half = {name: [fall_to(both["GI"][f], 0.5) * MILLI for f in (1, 2)] for name, both in walls.items()}
    dissipated = {name: [energy_per_section(both["GI"][f])["fracture"] for f in (1, 2)] for name, both in walls.items()}
    shown = [
        f"{n}: {percent(m[0])} and {percent(m[1])}; half the peak {half[n][0]:.3f} and {half[n][1]:.3f} mm past it "
        f"({half[n][1] / half[n][0]:.1f} times), fracture energy {dissipated[n][0]:.1f} and {dissipated[n][1]:.1f} N/m"
        for n, m in moved.items()
    ]
    return claim("A drastic change of the response once the units have twice the GI of the interface", "6, Fig. 18a",
                 f"mode 2: twice GI moves the curve more than {DRASTIC:g} times as far, on average, as twice GII does, "
                 "of which the paper has higher residual stresses alone",
                 f"of the peak, twice GI and twice GII: {'. '.join(shown)}",
                 all(tension > DRASTIC * shear for tension, shear in moved.values()), "both move it alike")  # fmt: skip


def residual_claim(walls: Mapping[str, Both]) -> Claim:
    """More shear energy of the units."""
    late = {name: [tail(both["GII"][f]) * MEGA for f in (1, 2, 4)] for name, both in walls.items()}
    rough = [values for name, values in late.items() if name != "grid"]
    shown = "; ".join(f"{name}: {' / '.join(f'{v:.4f}' for v in values)} MPa" for name, values in late.items())
    return claim("An increased GII of the bricks gives higher residual stresses, due to crack face bridging",
                 "6, Fig. 18b",
                 f"mode 2, random cells: mean stress over the last third rises by > {percent(RESIDUAL)} with each "
                 "doubling of GII",
                 f"x 1 / 2 / 4: {shown}",
                 all(b > (1.0 + RESIDUAL) * a for values in rough for a, b in zip(values, values[1:], strict=False)),
                 "the faces of a crack between cells slide on each other only where they are oblique and "
                 "still pressed; on a regular grid they never do, and GII has no effect at all")  # fmt: skip


def pattern_claim(name: str, series: Series) -> Claim:
    """Where the crack runs with 20 N/m."""
    base, tough = crack_path(series[1]), crack_path(series[2.5])
    moved = float(np.abs(np.subtract(tough.place(), base.place())).max())
    return claim(f"Higher tensile energies of the units change crack propagation and fracture surface: {name}",
                 "6, Fig. 19",
                 f"mode 2, GI of the units 20 N/m: the crack moves or widens by > {STRAIGHT * MILLI:.0f} mm along the "
                 "wall",
                 f"at {where(series[1])} mm, units {base.fractions()['units']:.2f} of the section; with 20 N/m at "
                 f"{where(series[2.5])} mm, units {tough.fractions()['units']:.2f}",
                 moved > STRAIGHT, "strength decides where a crack begins, and that is the same. Of the "
                 "units less is broken through at the end, because tearing takes longer; half the "
                 "loading error moves the peak by < 1 %")  # fmt: skip


def tension_claim(walls: Mapping[str, Both]) -> Claim:
    """Failure mode of the units of Fig. 19."""
    fractions = {}
    for name, both in walls.items():
        crack = crack_path(both["GI"][2.5])
        led = crack.frame.damage_tension >= crack.frame.damage_shear
        chosen = crack.broken & crack.unit
        fractions[name] = float(np.average(led[chosen], weights=crack.area[chosen])) if chosen.any() else 0.0
    return claim("Tensile failure of the bricks at GI = 20 N/m", "6, Fig. 19",
                 "mode 2: more than half of what is broken within units is led by tension",
                 "; ".join(f"{name}: {100 * fraction:.0f} %" for name, fraction in fractions.items()),
                 min(fractions.values()) > 0.5, "with GI as large as GII, the oblique faces between cells "
                 "slide apart before they are torn: more of them break by shear")  # fmt: skip
