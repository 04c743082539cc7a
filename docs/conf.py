"""The documentation site: `make docs` builds it into site/. It needs no network, neither here nor in the browser."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "docs" / "_ext")]
os.environ["PYTHONPATH"] = str(ROOT)  # what a notebook imports is what stands here

from masonry import __version__  # noqa: E402

project = "The masonry laboratory"
author = "the authors of masonry-dem"
copyright = "GPL-2.0-or-later"  # noqa: A001
release = version = __version__

of_ours = ["mathml", "docstrings", "commands", "gallery", "outputs", "tables"]  # docs/_ext
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_copybutton", *of_ours]
exclude_patterns = ["_ext", "_generated"]
smartquotes = False

myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 4
nb_execution_mode = "cache"
newest = max(path.stat().st_mtime_ns for folder in ("masonry", "geometry") for path in (ROOT / folder).rglob("*.py"))
nb_execution_cache_path = str(ROOT / "build" / "notebooks" / f"{newest:x}")  # another program gives other outputs
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 300

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_class_signature = "mixed"
highlight_language = "none"
maximum_signature_line_length = 80

html_theme = "furo"
html_title = "The masonry laboratory"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_copyright = False
html_show_sphinx = False
html_copy_source = False
html_math_renderer = "mathml"
copybutton_exclude = ".linenos, .gp, .go"
