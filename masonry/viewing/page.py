"""The page: data, the drawing program and its library in one file of HTML, which needs no network.

The library is three.js 0.187.0 (MIT licence, assets/three-LICENSE), bundled with what the page uses of it and nothing
else: CONTRIBUTING.md says how. It is 0.66 MB; the pages of k3d 3.2 and plotly.js 3 begin with 4.6 MB, k3d tells no
block that is clicked, plotly writes each frame whole, and vtk.js by trame has no slider of frames without a server.
"""

import json
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.named_file import MARK

ASSETS = files("masonry.viewing") / "assets"
SUFFIX = ".html"


def page_text(title: str, content: dict[str, Any], arrays: str) -> str:
    """The page of a model or a result.

    content  what the page shows, as JSON has it; arrays: numbers, as `Buffers.text` writes them
    """
    data = json.dumps(content, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="generator" content="{MARK}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(title)}</title>
<style>
{_asset("viewer.css")}</style>
</head>
<body>
{_asset("viewer.html")}<script id="content" type="application/json">{data}</script>
<script id="arrays" type="text/plain">{arrays}</script>
<script>
{_asset("three.min.js")}</script>
<script>
{_asset("viewer.js")}</script>
</body>
</html>
"""


def _asset(name: str) -> str:
    return (ASSETS / name).read_text(encoding="utf-8")


def require_page(path: Path) -> None:
    """Raise SceneError for another suffix than that of a page."""
    if path.suffix != SUFFIX:
        raise SceneError(f"'{path}': a view is a {SUFFIX} file; nearest: '{path.stem or 'view'}{SUFFIX}'")
