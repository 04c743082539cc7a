"""Response spectra of a run as a picture: pseudo-acceleration over the period."""

from typing import TYPE_CHECKING, Any

from masonry.curves.response_spectra import GaugeSpectrum
from masonry.curves.settling_curve import COLOURS
from masonry.pictures.labels import key_beside
from masonry.pictures.style import number_logarithms, plain, tidy
from masonry.rows.columns import GRAVITY

if TYPE_CHECKING:
    from masonry.results.data import ResultData


def spectra_figure(result: "ResultData", spectra: list[GaugeSpectrum]) -> Any:
    """A figure of 1200 x 720 pixels; grey where the rows of the run show no motion so fast."""
    from masonry.pictures.figure import ShownFigure

    figure = ShownFigure(figsize=(7.5, 4.5), layout="constrained")
    axes = figure.subplots()
    figure.suptitle(plain(result.title), fontsize=13, wrap=True)
    tidy(axes)
    for spectrum, colour in zip(spectra, len(spectra) * COLOURS, strict=False):
        answers = spectrum.answers
        axes.plot(
            answers.periods,
            answers.pseudo_acceleration / GRAVITY,
            color=colour,
            linewidth=1.6,
            label=plain(spectrum.name),
        )
    periods, shortest = spectra[0].answers.periods, max(spectrum.shortest for spectrum in spectra)
    if shortest > periods[0]:
        axes.axvspan(periods[0], shortest, color="0.9", zorder=0, label="faster than rows show")
    axes.set_xscale("log")
    number_logarithms(axes.xaxis)
    axes.set_xlim(periods[0], periods[-1])
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel("period [s]")
    axes.set_ylabel(f"pseudo-acceleration [g], {100.0 * spectra[0].answers.damping:g} % of critical damping")
    key_beside(axes)
    return figure
