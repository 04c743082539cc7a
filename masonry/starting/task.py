"""A task: its options, the template of its scene, and the commands that come next."""

import json
import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from string import Template
from typing import Any

from masonry.starting.options import Entries, TaskOption, guesses

DENSITY = TaskOption(
    "density",
    "of the stones or bricks",
    kind="density",
    unit="kg/m^3",
    default="2200",
    allowed="[100, 10000]",
    key="material.units.density",
    guess="1500 to 1900 for brick, 2000 to 2700 kg/m3 for stone; weigh a piece",
)
FRICTION = TaskOption(
    "friction",
    "tangent of the friction angle of the joints",
    kind="number",
    unit="",
    default="0.65",
    allowed="[0.05, 5]",
    key="contact.unit_unit.tan_friction_angle",
    guess="dry stone and brick: 0.6 to 0.75; a tilt test of two stones tells (docs/dry-joints.md)",
)
DRY_STIFFNESS = (
    "contact.unit_unit.normal_stiffness",
    "dry joints: 10 to 100 GPa/m; it moves the factor by less than its accuracy (docs/stiffness.md)",
)
BOUND = "`masonry limit` has stones rise as they slide, a bound from above; --no-dilation, in minutes, is as a run."
"""Beside the two answers for stones that slide."""
COLUMN = 34
"""Of comments behind a value."""


@dataclass(frozen=True)
class StartTask:
    """A first scene that `masonry new` can write.

    template  text of the scene with $placeholders, from below its title to above its assumptions
    values    the other placeholders, by name, from the options. Raises SceneError with the option to blame
    steps     commands that come next, with $file for the scene and $placeholders
    assumptions  keys and words of what is assumed besides the options; `notes` are lines below the steps
    """

    name: str
    says: str
    options: tuple[TaskOption, ...]
    template: str
    values: Callable[[Entries], dict[str, Any]]
    steps: tuple[str, ...]
    assumptions: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()

    def filled(self, values: Mapping[str, Any], file: str, dashes: str = "") -> tuple[str, list[str]]:
        """The text of the scene, and the commands that come next."""
        entries = Entries(self.options, values, dashes)
        words = {**self.values(entries), "file": shlex.quote(file)}
        for option in self.options:
            if len(entries_of := entries.optional(option.name)) == 1:
                words.setdefault(option.name, entries_of[0].text)
        steps = [Template(step).substitute(words) for step in self.steps]
        assumed = [*guesses(self.options, entries), *self.assumptions]
        head = ["# $title", f"# Made by `masonry new {self.name}`; every number is yours to change. Next:"]
        head += [f"#   {step}" for step in steps] + [f"# {line}" for line in self.notes]
        tail = ["[assumptions]  # what nobody gave, and what is usual; change a number, and say here where it is from"]
        tail += [f"{json.dumps(key)} = {json.dumps(says)}" for key, says in assumed]
        text = "\n".join([*head, 'title = "$title"', self.template, *tail])
        return aligned_comments(Template(text).substitute(words)) + "\n", steps


def aligned_comments(text: str) -> str:
    """A scene whose comments behind a value begin in one column."""
    lines = []
    for line in text.split("\n"):
        code, mark, comment = line.partition("  # ")
        lines.append(f"{f'{code}  ':<{COLUMN}}# {comment}" if mark and code.strip() and code[:1] != "#" else line)
    return "\n".join(lines)
