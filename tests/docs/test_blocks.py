"""Every block of code of every page runs as a reader would run it; those called slow, with `pytest -m slow`."""

import pytest

from masonry.errors import SceneError
from tests.docs.pages import RUN, SHOWN, blocks, blocks_of, pages
from tests.docs.running import Reader

PAGES = {page: blocks(page) for page in pages()}


def says(lines: str) -> None:
    """Read a page with these lines in the present folder."""
    from pathlib import Path

    Reader("page.md", blocks_of(lines), Path.cwd()).read(slow=False)


@pytest.fixture(autouse=True)
def empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("page", [page for page, listed in PAGES.items() if listed])
def test_the_code_of_a_page_runs(page, empty_folder):
    Reader(page, PAGES[page], empty_folder).read(slow=False)


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page, listed in PAGES.items() if any(block.slow for block in listed)])
def test_the_code_of_a_page_runs_with_what_is_slow(page, empty_folder):
    Reader(page, PAGES[page], empty_folder).read(slow=True)


@pytest.mark.parametrize("page", PAGES)
def test_every_block_says_its_language(page):
    known = (*RUN, *SHOWN)
    unknown = [
        f"line {b.line}: '{b.language}'" for b in PAGES[page] if b.language not in known and b.language[:1] != "{"
    ]
    assert not unknown, f"{page}: {', '.join(unknown)}; known are {', '.join(known)}, and directives in braces"


def test_the_pages_of_the_repository_are_found_with_their_code():
    assert {"README.md", "CONTRIBUTING.md", "docs/scene.md", "docs/sweep.md", "docs/index.md"} <= set(PAGES)
    languages = {block.language for block in PAGES["README.md"]}
    assert {"python", "toml", "bash"} <= languages


def test_python_goes_on_with_the_names_of_the_block_before():
    says("```python\na = 2\n```\nand\n```python\nassert a == 2\n```\n")


@pytest.mark.parametrize(
    "wrong",
    [
        "```python\nassert False\n```\n",
        "```python\nthere is no such thing\n```\n",
        "```bash\nmasonri list\n```\n",
        "```bash\nmasonry list | head\n```\n",
        "```bash\nmasonry check nowhere.toml\n```\n",
        "```console\nmasonri list\n```\n",
        "```toml\n[[[\n```\n",
        '```toml\n[drive]\nrat = "1 mm/s"\n```\n',
        '```toml\nbase = "couplet"\nlaw = "cubic"\n```\n',
        '```toml\nscene = "couplet"\n[grid]\nlaw = ["cubic"]\n```\n',
        "```json\n{1: 2}\n```\n",
        "```python\nprint('load 1.5 kN')\n```\n```text\nload 1.6 kN\n```\n",
        "```bash\nmasonry law\n```\nprints\n```text\nexponental\n```\n",
        "<!-- slow -->\n```bash\nmasonry run couplet --treads 2\n```\n",
        "<!-- not run: it takes a cluster -->\n```bash\nmasonry sweep\n```\n",
    ],
)
def test_what_is_wrong_in_a_block_is_found(wrong):
    with pytest.raises((AssertionError, SyntaxError, SystemExit, SceneError)):
        says(wrong)


def test_text_after_a_block_is_what_it_prints_but_for_rounding_and_times():
    says("```python\nprint('load 1.5001 kN in 0.3 s')\n```\nshows\n```text\n...\nload 1.5 kN in 2.1 s\n```\n")
    says("```python\nprint('gap 1e-15')\n```\n```text\ngap 3e-14\n```\n")
    says("```python\n1\n```\n<!-- not run: another scene -->\n```text\nload 2 kN\n```\n")


def test_a_file_that_a_block_names_is_there_for_the_commands():
    says('```bash\nmasonry check own.toml\n```\n```toml\n# own.toml\nbase = "couplet"\nlaw = "linear"\n```\n')


def test_a_command_may_be_shown_to_fail_with_its_exit_code():
    says("<!-- exit 2 -->\n```console\n$ masonry check nowhere.toml\nmasonry: no scene\n```\n")
