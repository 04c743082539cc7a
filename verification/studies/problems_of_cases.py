"""Which problems of error against run time stand for a case of the catalogue, or why there is nothing to choose."""

from verification.catalogue import catalogue
from verification.html import page
from verification.studies.refinement import anchor, problems


def table() -> str:
    """A row for each case: its problems, or the reason."""
    known = {problem.name: problem for problem in problems()}
    rows: list[list[str | page.Link | list[page.Link] | page.TableCell]] = []
    for name, case in catalogue().items():
        links = [page.Link(known[key].title, anchor(known[key])) for key in case.problems]
        reason = page.TableCell(case.no_problems, "text")
        rows.append([page.Link(case.title, f"case-{name}"), case.row, links or reason])
    return page.table(["case", "row", "its problems, or why there is nothing to choose"], rows, CAPTION)


CAPTION = "Every case of the catalogue, and the problems of this chapter that stand for it"
