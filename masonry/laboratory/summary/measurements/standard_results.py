"""Results of a test by a standard, where the scene names one."""

from masonry.assembly.assemble import Assembly
from masonry.results.records.laboratory_record import StandardResults
from masonry.rows.standard_test import compression, diagonal_compression
from masonry.timeloop.run_outcome import Outcome


def standard_results(assembly: Assembly, outcome: Outcome) -> StandardResults | None:
    """Strength and modulus by the standard; None without one."""
    standard, rows = assembly.scene.standard, outcome.standing_rows
    if standard is None or assembly.scene.drive is None or not rows["displacement"].any():
        return None
    begun = max(int((rows["displacement"] != 0.0).argmax()) - 1, 0)
    force, shortening = rows["stress"][begun:] * assembly.specimen.section, rows[standard.shortening][begun:]
    if standard.extension is None:
        area = standard.area or assembly.specimen.section
        results = compression(force, shortening, area, standard.gauge_length)
    else:
        area = standard.area or assembly.specimen.section
        results = diagonal_compression(force, shortening, rows[standard.extension][begun:], area, standard.gauge_length)
    return StandardResults(
        test=standard.test,
        area_m2=area,
        strength_pa=results.strength,
        modulus_pa=results.modulus,
        strain_at_third=results.strain,
    )
