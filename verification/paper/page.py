"""The page "The paper": what holds and what does not, then every experiment with its pictures."""

from collections.abc import Sequence

from masonry.runtime.progress import duration
from verification.html import cover
from verification.html.page import Chapter, Link, TableCell, Verdict, heading, link_line, paragraph, table
from verification.paper.experiment import Claim, Misprint, Shown

TITLE = "The paper, whole"
GROUP = "The paper"
CLAIMS = "paper-claims"
WORDS = {True: ("holds", "ok"), False: ("does not hold", "bad"), None: ("cannot be decided", "none")}
REFERENCE = (
    "Discontinuum analysis of the fracture mechanism in masonry prisms and wallettes via discrete element method"
)
"""Title of the reference paper."""
CITATION = "Pulatsu, Erdogmus, Lourenço, Lemos and Hazzard, Meccanica 55 (2020), doi:10.1007/s11012-020-01133-1"
"""Its authors, year and DOI: not checked against the publisher, see docs/paper.md."""
LEAD = (
    f"The reference paper is “{REFERENCE}” ({CITATION}; not checked against the publisher). "
    "All its experiments were run again. This page shows its figures as this "
    "program computes them, and compares each of its claims with what came out. The figures of the paper are lost, so "
    "no curve of the paper stands beside ours. Where a claim does not hold, the row says why, and what was done to "
    "make sure that it is not an error of solving."
)
HEADER = ("claim", "where", "check", "measured", "verdict")
MISPRINTED = ("where", "as printed", "what that comes to", "as built")


def chapters(shown: Sequence[Shown]) -> list[Chapter]:
    """A chapter with all claims, then one for each experiment, which leads back to its claims."""
    first = Chapter("Claims", group=GROUP, anchor=CLAIMS, verdicts=[verdict(shown)])
    first.parts += [paragraph(LEAD, "lead"), *tables(shown)]
    return [first, *map(chapter, shown)]


def tables(shown: Sequence[Shown]) -> list[str]:
    """The claims of the paper by experiment; below them its misprints, and what must hold of our runs."""
    claims = [
        heading(s.experiment.title, f"{CLAIMS}-{s.experiment.name}") + table(HEADER, [row(c) for c in s.section.claims])
        for s in shown
        if s.section.claims
    ]
    sound = [
        [Link(s.experiment.title, s.experiment.name), TableCell(c.says, "claim"), *row(c)[2:]]
        for s in shown
        for c in s.soundness
    ]
    return [
        *claims,
        *([misprint_table(misprints)] if (misprints := [m for s in shown for m in s.section.misprints]) else []),
        heading("How sound the runs are"),
        table(("experiment", "what must hold", "check", "measured", "verdict"), sound),
    ]


def misprint_table(misprints: Sequence[Misprint]) -> str:
    """The list as a table."""
    rows = [
        (m.where, TableCell(m.printed, "claim"), TableCell(m.comes_to, "claim"), TableCell(m.built, "claim"))
        for m in misprints
    ]
    return table(MISPRINTED, rows, f"Misprints: {len(misprints)}")


def row(claim: Claim) -> list[str | TableCell]:
    """The cells of a claim, coloured by whether it holds."""
    word, kind = WORDS[claim.holds]
    words = (
        TableCell(claim.says, "claim"),
        claim.source,
        TableCell(claim.check, "claim"),
        TableCell(claim.measured, "claim"),
    )
    return [*words, TableCell(word, kind, claim.why)]


def chapter(shown: Shown) -> Chapter:
    """The page of an experiment: its pictures, and a link to its claims."""
    made = shown.as_chapter()
    if shown.section.claims:
        made.parts.append(link_line("Its claims, and what came out", f"{CLAIMS}-{shown.experiment.name}"))
    made.parts += [misprint_table(shown.section.misprints)] if shown.section.misprints else []
    made.parts.append(paragraph(f"{shown.count} runs, {duration(shown.seconds)} of computing.", "note"))
    return made


def verdict(shown: Sequence[Shown]) -> Verdict:
    """How many claims hold."""
    claims = [c for s in shown for c in s.section.claims]
    held, broken, open_ = (sum(c.holds is answer for c in claims) for answer in (True, False, None))
    unsound = [c for s in shown for c in s.soundness if not c.holds]
    kind = "bad" if unsound else "warn" if broken or open_ else "ok"
    sound = f"; {len(unsound)} demands on the runs are not met" if unsound else "; all runs are sound"
    sentence = f"Of {len(claims)} claims {held} hold, {broken} do not, {open_} cannot be decided{sound}."
    return Verdict("The paper", kind, sentence)


def html_of(shown: Sequence[Shown], seconds: float, quick: bool) -> str:
    """The page by itself, as one HTML file."""
    made = chapters(shown)
    note = "A quick look: fewer runs, and loading errors four times as large. " if quick else ""
    lead = paragraph(f"{note}{verdict(shown).sentence}", "lead")
    contents = "".join([lead, cover.origin(seconds)])
    return cover.bound(TITLE, contents, made)
