"""Outputs of notebooks: what a line of progress leaves behind when it goes is an empty box, which is taken out."""

from typing import Any

from docutils import nodes


def _drop_empty(app: Any, tree: nodes.document, name: str) -> None:
    """Take out every output of a cell that is text without a letter."""
    for block in list(tree.findall(nodes.literal_block)):
        if "output" in block["classes"] and not block.astext().strip():
            block.parent.remove(block)


def setup(app: Any) -> dict[str, bool]:
    """Listen where pages are about to be written."""
    app.connect("doctree-resolved", _drop_empty)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
