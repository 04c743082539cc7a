"""Which ladders of error against run time stand for a case of the catalogue, or why there is nothing to choose."""

from collections.abc import Mapping

from verification.case import Case
from verification.catalogue import catalogue
from verification.html import page
from verification.studies.ladders import problems


def gaps(cases: Mapping[str, Case]) -> list[str]:
    """What is wrong with the cases, in sentences: neither ladder nor reason, or both; a wrong name."""
    known = {problem.name for problem in problems()}
    found = []
    for name, case in cases.items():
        if bool(case.ladders) == bool(case.no_ladders):
            found.append(
                f"{name}: " + ("ladders, and a reason for none" if case.ladders else "neither ladders nor a reason")
            )
        found += [f"{name}: no ladder '{ladder}'" for ladder in case.ladders if ladder not in known]
    return found


def table() -> str:
    """A row for each case: its ladders, or the reason."""
    titles = {problem.name: problem.title for problem in problems()}
    rows: list[list[str | page.Link | list[page.Link] | page.Cell]] = []
    for name, case in catalogue().items():
        links = [page.Link(titles[ladder], f"ladder-{ladder}") for ladder in case.ladders]
        reason = page.Cell(case.no_ladders, "text")
        rows.append([page.Link(case.title, f"case-{name}"), case.row, links or reason])
    return page.table(["case", "row", "its ladders, or why there is nothing to choose"], rows, CAPTION)


CAPTION = "Every case of the catalogue, and the problems of this chapter that stand for it"
