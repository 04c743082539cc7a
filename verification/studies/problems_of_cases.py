"""Which problems of error against run time stand for a case of the catalogue, or why there is nothing to choose."""

from collections.abc import Mapping

from verification.case import Case
from verification.catalogue import catalogue
from verification.html import page
from verification.studies.refinement import anchor, problems


def gaps(cases: Mapping[str, Case]) -> list[str]:
    """What is wrong with the cases, in sentences: neither problem nor reason, or both; a wrong name."""
    known = {problem.name for problem in problems()}
    found = []
    for name, case in cases.items():
        if bool(case.problems) == bool(case.no_problems):
            found.append(
                f"{name}: " + ("problems, and a reason for none" if case.problems else "neither problems nor a reason")
            )
        found += [f"{name}: no problem '{problem}'" for problem in case.problems if problem not in known]
    return found


def table() -> str:
    """A row for each case: its problems, or the reason."""
    known = {problem.name: problem for problem in problems()}
    rows: list[list[str | page.Link | list[page.Link] | page.Cell]] = []
    for name, case in catalogue().items():
        links = [page.Link(known[key].title, anchor(known[key])) for key in case.problems]
        reason = page.Cell(case.no_problems, "text")
        rows.append([page.Link(case.title, f"case-{name}"), case.row, links or reason])
    return page.table(["case", "row", "its problems, or why there is nothing to choose"], rows, CAPTION)


CAPTION = "Every case of the catalogue, and the problems of this chapter that stand for it"
