"""In words: how a computed curve lies beside a measured one, and what a test by a standard reports."""

from masonry.results.records.laboratory_record import MeasuredBeside, StandardResults

WORDS = {"EN 1052-1": ("compressive strength", "E"), "ASTM E519": ("shear strength", "G")}


def measured_lines(beside: MeasuredBeside) -> list[str]:
    """Each number of ours, of the measured curve, and by how much ours differs."""
    lab, ours, upto = beside.measured, beside.computed, beside.compared_to_m
    if lab is None or ours is None or upto is None:
        return []
    energy = "within all loops" if beside.in_cycles else f"up to {1e3 * upto:.4g} mm"
    lines = [_beside("peak", ours.peak_n, lab.peak_n, 1e-3, "kN", beside.peak_difference)]
    if beside.in_cycles:
        lines.append(_beside("lowest", ours.lowest_n, lab.lowest_n, 1e-3, "kN", beside.lowest_difference))
    lines += [
        _beside("stiffness", ours.stiffness_n_per_m, lab.stiffness_n_per_m, 1e-6, "kN/mm", beside.stiffness_difference),
        _beside(f"energy {energy}", ours.energy_j, lab.energy_j, 1.0, "J", beside.energy_difference),
    ]
    apart = beside.farthest_apart
    return [*lines, *([] if apart is None else [f"envelopes are apart by at most {100 * apart:.3g} % of its peak"])]


def _beside(what: str, ours: float | None, theirs: float | None, factor: float, unit: str, share: float | None) -> str:
    numbers = ["not reached" if value is None else f"{factor * value:.4g} {unit}" for value in (ours, theirs)]
    return f"{what} {numbers[0]}, measured {numbers[1]}" + ("" if share is None else f" ({100 * share:+.3g} %)")


def standard_lines(results: StandardResults) -> list[str]:
    """Strength and modulus."""
    strength, modulus = WORDS.get(results.test, ("strength", "modulus"))
    if results.strength_pa is None:
        return []
    words = f"{results.test}: {strength} {1e-6 * results.strength_pa:.4g} MPa"
    if results.modulus_pa is None:
        return [f"{words}; {modulus} is not known: the curve has no third of the largest force"]
    return [f"{words}, {modulus} {1e-9 * results.modulus_pa:.4g} GPa (secant at a third of the largest force)"]
