"""The site builds without a warning, whole, and opens without a network. Slow: `make docs` builds it in each check."""

import importlib.util
import re
import subprocess
import sys

import pytest
from docutils import nodes

from tests.docs.pages import ROOT, pages

of_the_site = pytest.mark.slow
NOTEBOOKS = ("-D", "nb_execution_mode=off")  # the tutorial is run by a test of its own


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site, built anew with every warning an error."""
    folder = tmp_path_factory.mktemp("site")
    words = ["-m", "sphinx", "-W", "--keep-going", "-q", *NOTEBOOKS, "-d", f"{folder}/trees", "docs", f"{folder}/html"]
    done = subprocess.run([sys.executable, *words], cwd=ROOT, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return folder / "html"


@of_the_site
def test_every_page_of_the_documentation_is_in_the_site(site):
    names = [page.removeprefix("docs/").removesuffix(".md") for page in pages() if page.startswith("docs/")]
    assert len(names) > 10
    assert [name for name in names if not (site / f"{name}.html").is_file()] == []


@of_the_site
def test_no_page_asks_for_anything_from_the_network(site):
    asked = re.compile(r'<(?:script|img|iframe)[^>]+src="(?:https?:)?//|<link[^>]+href="(?:https?:)?//')
    names = {page.name for page in site.rglob("*.html") if asked.search(page.read_text(encoding="utf-8"))}
    assert names == set()


@of_the_site
def test_formulas_are_mathml_and_say_what_they_should(site):
    page = (site / "theory" / "contact-laws.html").read_text(encoding="utf-8")
    assert page.count("<math") > 10 and "<merror" not in page
    assert "$$" not in page and "\\frac" not in page


@of_the_site
def test_the_reference_shows_docstrings_and_every_command(site):
    python = (site / "reference" / "python.html").read_text(encoding="utf-8")
    assert "masonry.load" in python and "Raises SceneError" in python
    laws = (site / "reference" / "laws.html").read_text(encoding="utf-8")
    assert "|tau| &lt;= c - sigma tan(phi)" in laws and "sigma &gt; 0 is tension" in laws
    assert "(P, 3) m, corners" in (site / "reference" / "geometry.html").read_text(encoding="utf-8")
    commands = (site / "reference" / "commands.html").read_text(encoding="utf-8")
    assert all(f'id="masonry-{name}"' in commands for name in ("run", "check", "sweep", "verify", "paper"))
    assert "--scheduler ADDRESS" in commands


@of_the_site
def test_the_gallery_shows_every_packaged_scene_with_its_picture(site):
    from masonry.scene import packaged

    page = (site / "gallery.html").read_text(encoding="utf-8")
    assert all(f'id="{name}"' in page for name in packaged())
    pictures = set(re.findall(r'src="_images/([^"]+)"', page))
    assert len(pictures) >= len(packaged())
    assert all((site / "_images" / name).stat().st_size > 10_000 for name in pictures)


@of_the_site
def test_cells_of_wide_tables_carry_the_name_of_their_column_for_narrow_screens(site):
    page = (site / "scene.html").read_text(encoding="utf-8")
    assert page.count('<td data-name="meaning">') > 50
    narrow = re.search(r"<table.*?</table>", page, re.DOTALL)
    assert narrow and "data-name" not in narrow[0], "a table of three columns stays a table"


def test_an_empty_output_of_a_cell_is_taken_out_and_no_other():
    spec = importlib.util.spec_from_file_location("outputs", ROOT / "docs" / "_ext" / "outputs.py")
    outputs = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(outputs)
    tree = nodes.document(None, None)
    for text, classes in (("\n", ["output", "text_plain"]), ("1.375", ["output", "text_plain"]), ("", ["code"])):
        tree += nodes.literal_block(text, text, classes=classes)
    outputs._drop_empty(None, tree, "tutorial")
    assert [block.astext() for block in tree.children] == ["1.375", ""]
