"""The share that falls as a lognormal distribution of the intensity that it takes, by maximum likelihood.

    P(fall | x) = Phi(ln(x/theta)/beta) = Phi(a + b ln x),   theta = exp(-a/b),  beta = 1/b

The logarithm of the likelihood is concave in a and b; Fisher's scoring finds its top. Runs of one record at several
scales are no independent tests: the covariance adds up their scores record by record (White's sandwich), where records
have more than one run. Where all that fell lies above all that stood no finite slope is the most likely one, and none
is given: intensities nearer to each other, or more records, are needed.

References: Baker, Earthquake Spectra 31(1), 2015, 579-599; White, Econometrica 50(1), 1982, 1-25.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MOST_ROUNDS = 100
STEEPEST = 30.0
"""Scores of the normal distribution beyond which a probability is 0 or 1 to the last digit."""


@dataclass(frozen=True)
class LognormalFit:
    """median      intensity theta at which half of all fall
    dispersion  beta, the standard deviation of the logarithm of the intensity
    covariance  (2, 2) of ln(median) and dispersion
    line        a and b
    of_line     (2, 2) covariance of a and b
    log_likelihood  of the runs
    """

    median: float
    dispersion: float
    covariance: np.ndarray
    line: np.ndarray
    of_line: np.ndarray
    log_likelihood: float

    def share(self, intensity: np.ndarray) -> np.ndarray:
        """(n,) share that falls at intensities (n,)."""
        from scipy.special import ndtr

        share: np.ndarray = ndtr(_columns(intensity) @ self.line)
        return share

    def band(self, intensity: np.ndarray, confidence: float) -> tuple[np.ndarray, np.ndarray]:
        """(n,) least and largest share at a confidence, point by point: that of a normal a + b ln x."""
        from scipy.special import ndtr, ndtri

        columns = _columns(intensity)
        spread = ndtri(0.5 + 0.5 * confidence) * np.sqrt(np.einsum("ni,ij,nj->n", columns, self.of_line, columns))
        return ndtr(columns @ self.line - spread), ndtr(columns @ self.line + spread)

    def median_band(self, confidence: float) -> tuple[float, float]:
        """Least and largest median at a confidence: that of a normal logarithm."""
        from scipy.special import ndtri

        spread = float(ndtri(0.5 + 0.5 * confidence) * np.sqrt(self.covariance[0, 0]))
        return self.median * float(np.exp(-spread)), self.median * float(np.exp(spread))


def why_no_fit(intensity: np.ndarray, fallen: np.ndarray) -> str:
    """Why runs (n,) have no most likely lognormal distribution; "" where they have one."""
    if not fallen.any() or fallen.all():
        return f"{'none' if not fallen.any() else 'all'} of {len(fallen)} runs fell"
    least_fallen, most_standing = intensity[fallen].min(), intensity[~fallen].max()
    if least_fallen >= most_standing:
        where = (
            f"at {least_fallen:.4g}" if least_fallen == most_standing else f"{most_standing:.4g} to {least_fallen:.4g}"
        )
        return (
            f"all that fell lies above all that stood ({where}): how steep the curve is cannot be said; take more "
            "intensities there, or more records"
        )
    if intensity[~fallen].min() >= intensity[fallen].max():
        return "all that fell lies below all that stood: this intensity does not say what falls"
    if np.ptp(intensity) == 0.0:
        return "all runs have one intensity"
    return ""


def lognormal_fit(intensity: np.ndarray, fallen: np.ndarray, records: Sequence[int] | None = None) -> LognormalFit:
    """The most likely distribution.

    intensity  (n,) above 0, of the runs      fallen  (n,) bool
    records    (n,) a number for each run, the same for runs that belong together; None: all are independent
    Raises ValueError with the reason where there is none, or more falls at smaller intensities than at larger ones.
    """
    intensity, fallen = np.asarray(intensity, dtype=float), np.asarray(fallen, dtype=bool)
    if len(intensity) != len(fallen) or not (intensity > 0.0).all():
        raise ValueError("intensities must be above 0, one for each run")
    if why := why_no_fit(intensity, fallen):
        raise ValueError(why)
    columns = _columns(intensity)
    center, width = columns[:, 1].mean(), columns[:, 1].std()
    scaled = np.column_stack([columns[:, 0], (columns[:, 1] - center) / width])
    line = _most_likely(scaled, fallen)
    back = np.array([[1.0, -center / width], [0.0, 1.0 / width]])
    of_line = back @ _covariance(scaled, fallen, line, records) @ back.T
    line = back @ line
    if line[1] <= 0.0:
        raise ValueError("not more falls at larger intensities than at smaller ones: no curve that grows fits")
    a, b = line
    slope = np.array([[-1.0 / b, a / b**2], [0.0, -1.0 / b**2]])
    likelihood = float(_log_share(np.where(fallen, 1.0, -1.0) * (columns @ line)).sum())
    return LognormalFit(float(np.exp(-a / b)), float(1.0 / b), slope @ of_line @ slope.T, line, of_line, likelihood)


def _columns(intensity: np.ndarray) -> np.ndarray:
    return np.column_stack([np.ones(len(intensity)), np.log(intensity)])


def _log_share(score: np.ndarray) -> np.ndarray:
    from scipy.special import log_ndtr

    log_share: np.ndarray = log_ndtr(score)
    return log_share


def _hazard(score: np.ndarray) -> np.ndarray:
    """The normal density over its share below: what a run that fell adds to the score."""
    hazard: np.ndarray = np.exp(-0.5 * score**2 - 0.5 * np.log(2.0 * np.pi) - _log_share(score))
    return hazard


def _most_likely(columns: np.ndarray, fallen: np.ndarray) -> np.ndarray:
    """The numbers a and b, by Fisher's scoring with steps that are halved until the likelihood grows."""
    signs = np.where(fallen, 1.0, -1.0)
    line = np.zeros(2)
    likelihood = _log_share(signs * (columns @ line)).sum()
    for _ in range(MOST_ROUNDS):
        score = columns @ line
        gradient = columns.T @ (signs * _hazard(signs * score))
        step = np.linalg.solve(_information(columns, score), gradient)
        if gradient @ step < 1e-14:
            break
        while (after := _log_share(signs * (columns @ (line + step))).sum()) < likelihood:
            step = 0.5 * step
            if np.abs(step).max() < 1e-13:
                return line
        line, likelihood = line + step, after
    return line


def _information(columns: np.ndarray, score: np.ndarray) -> np.ndarray:
    """(2, 2) Fisher's, of a and b."""
    score = np.clip(score, -STEEPEST, STEEPEST)
    information: np.ndarray = columns.T @ (columns * (_hazard(score) * _hazard(-score))[:, None])
    return information


def _covariance(columns: np.ndarray, fallen: np.ndarray, line: np.ndarray, records: Sequence[int] | None) -> np.ndarray:
    inverse = np.linalg.inv(_information(columns, columns @ line))
    numbers = np.arange(len(fallen)) if records is None else np.unique(records, return_inverse=True)[1]
    count = int(numbers.max()) + 1
    if count == len(fallen) or count < 3:
        return inverse
    signs = np.where(fallen, 1.0, -1.0)
    scores = columns * (signs * _hazard(signs * (columns @ line)))[:, None]
    sums = np.zeros((count, 2))
    np.add.at(sums, numbers, scores)
    sandwich: np.ndarray = inverse @ (sums.T @ sums) @ inverse * (count / (count - 1.0))
    return sandwich
