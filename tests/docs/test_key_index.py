"""The page of the scene file begins with an index of all tables and keys; it is what the schema says."""

import re

from tests.docs.key_index import HEAD, anchor, index
from tests.docs.pages import pages

PAGE = pages()["docs/scene.md"].read_text(encoding="utf-8")


def test_the_index_of_the_scene_file_is_that_of_the_schema():
    assert index() in PAGE, f"docs/scene.md: put this in place of the table below '{HEAD.splitlines()[0]}':\n{index()}"


def test_the_index_stands_before_the_first_key_and_its_links_lead_to_headings():
    assert PAGE.index(HEAD) < PAGE.index("| key | kind |")
    headings = {anchor(heading) for heading in re.findall(r"^##+ (.+)$", PAGE, re.MULTILINE)}
    assert set(re.findall(r"\]\(#([^)]+)\)", index())) <= headings
