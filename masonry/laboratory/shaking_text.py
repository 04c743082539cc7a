"""Rows of the command line on a run whose ground shakes."""

from masonry.results.summary import GaugeSwing, GroundComponent, Shaking
from masonry.rows.columns import GRAVITY
from masonry.runtime.tables import Rows

BY_INERTIA = "by the forces of inertia, in motion relative to the ground"
UNTIL_A_FALL = " until the first block had fallen"
BY_SUPPORTS = "by the supports that move"


def shaking_rows(shaking: Shaking, falls: bool = False) -> Rows:
    """Row by row: the ground, gauges, uplift, the largest force, and the energy that came in.

    falls  whether a block had fallen: the largest of all are those until then
    """
    grounds = [ground_text(axis, component) for axis, component in (shaking.ground or {}).items()]
    until = UNTIL_A_FALL if falls else ""
    most = f"at most{until}"
    uplift, force, energy = shaking.uplift, shaking.largest_force, shaking.input_energy_j
    return [
        ("ground", grounds),
        *((name, [swing_text(swing, falls)]) for name, swing in (shaking.gauges or {}).items()),
        (
            "uplift",
            [f"a joint opened by {1e3 * uplift.opening_m:.4g} mm after {uplift.time_s:.4g} s{until}: {uplift.between}"]
            if uplift is not None and uplift.opening_m > 0.0
            else [],
        ),
        (
            "contact force",
            [f"{force_words(force.force_n)} {most}, after {force.time_s:.4g} s: {force.between}"] if force else [],
        ),
        (
            "input energy",
            [] if energy is None else [f"{energy:.4g} J {BY_SUPPORTS if shaking.moves_supports else BY_INERTIA}"],
        ),
    ]


def ground_text(axis: str, of: GroundComponent) -> str:
    """One component: its peaks, and where it ends."""
    return (
        f"along {axis} for {of.duration_s:.4g} s: at most {of.peak_acceleration_m_s2 / GRAVITY:.4g} g, "
        f"{of.peak_velocity_m_s:.4g} m/s and {1e3 * of.peak_displacement_m:.4g} mm; "
        f"{1e3 * of.residual_displacement_m:.4g} mm away at its end"
    )


def swing_text(swing: GaugeSwing, falls: bool = False) -> str:
    """A gauge: the farthest that it went from where it was when the dead loads had settled, until a block had fallen
    where one `falls`; and what is left."""
    when = f"at most{UNTIL_A_FALL if falls else ''}, after {swing.time_s:.4g} s"
    if swing.quantity == "acceleration":
        return f"{swing.peak / GRAVITY:.4g} g {when}"
    if swing.quantity == "velocity":
        return f"{swing.peak:.4g} m/s {when}; {swing.residual:.4g} m/s at the end"
    drift = ""
    if swing.peak_drift is not None and swing.residual_drift is not None:
        drift = f"; drift {100.0 * swing.peak_drift:.3g} %, {100.0 * swing.residual_drift:.3g} % left"
    return f"{1e3 * swing.peak:.4g} mm {when}; {1e3 * swing.residual:.4g} mm left at the end{drift}"


def force_words(force: float) -> str:
    """N or kN."""
    return f"{force:.4g} N" if force < 1e3 else f"{1e-3 * force:.4g} kN"
