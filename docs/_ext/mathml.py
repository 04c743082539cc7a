"""Formulas as MathML, which browsers draw themselves: no script, no network. docutils turns the LaTeX into it."""

from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

LOGGER = logging.getLogger(__name__)


def inline(translator: HTML5Translator, node: nodes.math) -> None:
    """A formula within a line."""
    _write(translator, node, as_block=False)


def block(translator: HTML5Translator, node: nodes.math_block) -> None:
    """A formula that stands alone, with its number where it has a label."""
    number = node.get("number")
    translator.body.append(translator.starttag(node, "div", CLASS="math formula", IDS=node.get("ids", [])))
    _write(translator, node, as_block=True)
    if number:
        translator.body.append(f'<span class="eqno">({number})</span>')
    translator.body.append("</div>\n")
    raise nodes.SkipNode


def _write(translator: HTML5Translator, node: Any, as_block: bool) -> None:
    try:
        translator.body.append(tex2mathml(node.astext(), as_block=as_block))
    except MathError as error:
        LOGGER.warning("formula %r: %s", node.astext(), error, location=node)
    if not as_block:
        raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Make the renderer known to Sphinx."""
    app.add_html_math_renderer("mathml", inline_renderers=(inline, None), block_renderers=(block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
