"""How many contact points joints want that bend: the error of the peak, and what the run says of it."""

from collections.abc import Callable, Mapping

from verification import timed_run
from verification.html import page
from verification.studies.mortared_walls import ENOUGH, MortaredWall, said, walls

ORDER = 50
POINTS = (("gauss", 2), ("vertex", 2), ("gauss", 4), ("vertex", 4), ("gauss", 6), ("vertex", 6))
OFF = 0.05
"""Error of a peak that must be told, with its sign."""


def errors(wall: MortaredWall, points: tuple[tuple[str, int], ...] = POINTS) -> list[tuple[float, float]]:
    """(error of the peak against that by many points, what the run says of it) for each rule and number of points."""
    peaks, words = [], []
    for rule, number in (("gauss", ENOUGH), *points):
        run = timed_run.run(wall.scene, wall.with_points(rule, number))
        peaks.append(run.value("peak") if run.ok else float("nan"))
        words.append(said(run.summary) - 1.0)
    return [(peak / peaks[0] - 1.0, word) for peak, word in zip(peaks[1:], words[1:], strict=True)]


def chapter(
    tell: Callable[[str], None], chosen: Mapping[str, MortaredWall] | None = None, quick: bool = False
) -> page.Chapter:
    """A table of all walls (quick: of single blocks), and the verdict on what runs say of their own points."""
    made = page.Chapter("Contact points of joints that bend")
    rows: list[list[str | page.TableCell]] = []
    missed: list[str] = []
    wrong, worst, count = 0, 0.0, 0
    known = chosen or {name: wall for name, wall in walls().items() if name.startswith("block") or not quick}
    for name, wall in known.items():
        tell(f"points of joints that bend: {name}")
        rows.append([name])
        for (rule, number), (error, word) in zip(POINTS, errors(wall), strict=True):
            warned = (word > 0.0) == (error > 0.0) and word != 0.0
            good = warned if abs(error) > OFF else True
            missed += [] if good or word else [f"{name}, {number} points, {rule}"]
            wrong += not good and word != 0.0
            worst, count = max(worst, abs(error) if not word else 0.0), count + 1
            words = f"said {100.0 * word:+.2g} %" if word else "silent"
            rows[-1].append(page.judged(f"{100.0 * error:+.2g} %", good, words))
    header = ["wall", *(f"{number} points, {rule}" for rule, number in POINTS)]
    made.add(INTRODUCTION, page.table(header, rows, f"Error of the peak against {ENOUGH} Gauss points, and the words."))
    sentence = (
        f"{count} runs of {len(rows)} mortared walls with few contact points: {len(missed)} off by more than "
        f"{page.percent(OFF)} without a word{': ' + '; '.join(missed) if missed else ''}, {wrong} with the wrong sign; "
        f"the largest error under a silent sentence is {page.percent(worst)}."
    )
    made.judge("Contact points of joints that bend", "ok" if not missed and not wrong else "warn", sentence)
    return made


INTRODUCTION = (
    "A joint that bends open tears row by row of its contact points. Two Gauss points along an edge carry elastic "
    "bending exactly, but what the joint bears as it tears may be too much or too little. Points at the edges bear "
    "more than the joint. A run holds each of its joints that bend against one of many points, and says by how much "
    "its peak may be off. Where several joints of a wall share the bending, or sliding decides, that is more than the "
    "true error."
)
