"""Which problems of error against run time stand for a case of the catalogue, or why there is nothing to choose."""

from collections.abc import Mapping
from typing import Any

from verification.catalogue import modules
from verification.html import page
from verification.studies.refinement import anchor, problems


def problems_of(module: Any) -> tuple[str, ...]:
    """Names of the problems that stand for the case of a module: those that it names, and its own PROBLEMS."""
    return (*module.CASE.ladders, *(problem.name for problem in getattr(module, "PROBLEMS", ())))


def gaps(cases: Mapping[str, Any]) -> list[str]:
    """What is wrong with the modules of cases, in sentences: neither problem nor reason, or both; a wrong name."""
    known = {problem.name for problem in problems()}
    found = []
    for name, module in cases.items():
        named, reason = problems_of(module), module.CASE.no_ladders
        if bool(named) == bool(reason):
            found.append(
                f"{name}: " + ("problems, and a reason for none" if named else "neither problems nor a reason")
            )
        found += [f"{name}: no problem '{problem}'" for problem in named if problem not in known]
    return found


def table() -> str:
    """A row for each case: its problems, or the reason."""
    known = {problem.name: problem for problem in problems()}
    rows: list[list[str | page.Link | list[page.Link] | page.Cell]] = []
    for name, module in modules().items():
        links = [page.Link(known[key].title, anchor(known[key])) for key in problems_of(module)]
        reason = page.Cell(module.CASE.no_ladders, "text")
        rows.append([page.Link(module.CASE.title, f"case-{name}"), module.CASE.row, links or reason])
    return page.table(["case", "row", "its problems, or why there is nothing to choose"], rows, CAPTION)


CAPTION = "Every case of the catalogue, and the problems of this chapter that stand for it"
