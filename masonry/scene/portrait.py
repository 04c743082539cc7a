"""A scene at a glance: what it says of specimen, contacts and loading, on less than a screen."""

from typing import Any

from masonry.runtime.tables import Rows, aligned, html_table
from masonry.scene.checked import SceneData

READABLE = {"m": ((1e-3, "mm"),), "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"))}
"""Units of a scene, and those in which people read them: the first that the size reaches."""


def portrait_text(scene: SceneData) -> str:
    """For a terminal."""
    return f"Scene {_title(scene)}\n\n{aligned(portrait_rows(scene))}"


def portrait_html(scene: SceneData) -> str:
    """For a notebook."""
    return html_table(_title(scene), portrait_rows(scene))


def portrait_rows(scene: SceneData) -> Rows:
    """A word and its lines, for each part that the scene has."""
    tables = scene.resolved()
    rows = [
        ("specimen", [_words(scene.specimen.model_dump(exclude_defaults=True, exclude={"content"}))]),
        ("kinematics", [_words(tables["kinematics"])]),
        ("materials", [f"{group}: {_words(values)}" for group, values in tables["material"].items()]),
        ("contacts", [_contact(scene, group, values) for group, values in tables["contact"].items()]),
        ("scatter", [f"{group}: {_words(values)}" for group, values in tables.get("scatter", {}).items()]),
        ("supports", [f"{support.on}: {', '.join(support.fix)}" for support in scene.support]),
        ("confinement", [_words(tables["confinement"])] if scene.confinement is not None else []),
        ("traction", _each(tables, "traction")),
        ("fill", _each(tables, "fill")),
        ("vehicle", [_words(tables["vehicle"])] if scene.vehicle is not None else []),
        ("masses", _each(tables, "mass")),
        ("bars", _each(tables, "bar")),
        ("gravity", [_words(tables["gravity"])] if scene.gravity is not None else []),
        ("motion", _each(tables, "motion")),
        ("quiet", _each(tables, "quiet")),
        ("floor", [_words(tables.get("floor", {})) or "below"] if scene.floor is not None else []),
        ("drive", [_words(tables["drive"])] if scene.drive is not None else []),
        ("gauges", [gauge.name for gauge in scene.gauge]),
        ("assumptions", [f"{len(scene.assumptions)}, see scene.assumptions"] if scene.assumptions else []),
    ]
    return [(word, lines) for word, lines in rows if lines]


def _each(tables: dict[str, Any], name: str) -> list[str]:
    """A line for each table of a list of them."""
    return [_words(table) for table in tables.get(name, ())]


def _title(scene: SceneData) -> str:
    return f"{scene.name}: {scene.title}" if scene.title else scene.name


def _contact(scene: SceneData, group: str, values: dict[str, Any]) -> str:
    """Law and strengths: what is changed most often."""
    shown = ("tensile_strength", "cohesion", "fracture_energy_mode_1", "fracture_energy_mode_2")
    words = {"law": scene.contact[group].law, **{key: values[key] for key in shown if key in values}}
    return f"{group}: {_words(words)}"


def _words(value: Any) -> str:
    """Values in one line: `kind couplet, length 200 mm`."""
    if isinstance(value, dict):
        return ", ".join(f"{key} {_words(below)}" for key, below in value.items())
    if isinstance(value, (tuple, list)):
        return f"[{', '.join(map(_words, value))}]"
    number, _, unit = str(value).partition(" ")
    try:
        size = float(number)
    except ValueError:
        return str(value)
    factor, shown = next((s for s in READABLE.get(unit, ()) if abs(size) >= s[0]), (1.0, unit))
    return f"{size / factor:g} {shown}".rstrip()
